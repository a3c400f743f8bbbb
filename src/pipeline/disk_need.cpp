// SPDX-License-Identifier: Apache-2.0
#include "pipeline/disk_need.h"

#include "core/error.h"
#include "raster/atomic_file.h"

namespace skysweep::pipeline {

std::uint64_t disk_bytes(std::size_t tiles, const ProjectSettings& settings) {
  constexpr std::uint64_t kBytesPerCell = 4 + 4 + 4 + 1, kBytesPerParentCell = kBytesPerCell + 4;
  const auto cells = static_cast<std::uint64_t>(settings.lattice.tile_cells) * settings.lattice.tile_cells;
  return tiles * cells * (2 * kBytesPerCell + kBytesPerParentCell / 2);
}

void require_disk_space(const std::filesystem::path& project, std::uint64_t bytes) {
  const std::uint64_t free = raster::free_disk_space(project);
  if (free < bytes)
    throw failure("The disk that holds " + project.string() + " has " + std::to_string(free >> 20) +
                  " MiB free, and this run may need " + std::to_string(bytes >> 20) +
                  " MiB: free some, or choose another place with -o, a larger --cell or a smaller --aoi.");
}

}  // namespace skysweep::pipeline
