// SPDX-License-Identifier: Apache-2.0
#include "pipeline/memory_plan.h"

#include <unistd.h>

#include <algorithm>

#include "core/error.h"
#include "sweep/image_pyramid.h"

namespace skysweep::pipeline {
namespace {

constexpr std::size_t kMiB = 1 << 20;
constexpr std::size_t kProgramBytes = 160 * kMiB;  // measured: resident size after the libraries are loaded, and slack
constexpr std::size_t kBytesPerImageRecord = 16 << 10;
// Per cell of a tile with its collar: match result 21, heights 8, colours and counts 7, what the views show of it 51,
// the tile itself 13, and half as much again while GeoTIFFs are compressed.
constexpr std::size_t kBytesPerCell = 150;
// Decoding holds the file, the decoder's image, our copy and the pyramid at once.
constexpr double kDecodingOverhead = 2.5;
constexpr int kMostTilesInFlight = 4;

}  // namespace

std::size_t default_memory_limit() {
  const auto pages = sysconf(_SC_PHYS_PAGES), page_size = sysconf(_SC_PAGE_SIZE);
  return static_cast<std::size_t>(pages) * static_cast<std::size_t>(page_size) / 2;
}

MemoryPlan plan_memory(std::size_t limit_bytes, const std::vector<index::ImageRecord>& records,
                       const Configuration& configuration, int threads) {
  std::size_t largest_photo = 0, all_photos = 0;
  for (const index::ImageRecord& record : records) {
    if (record.status != index::ImageStatus::used) continue;
    const std::size_t bytes = sweep::ImagePyramid::bytes_for(record.model.width_px, record.model.height_px);
    largest_photo = std::max(largest_photo, bytes);
    all_photos += bytes;
  }
  MemoryPlan plan;
  plan.limit_bytes = limit_bytes;
  plan.program_bytes = kProgramBytes + records.size() * kBytesPerImageRecord;
  const auto width = static_cast<std::size_t>(configuration.tiles.cells + 2 * configuration.tiles.collar_cells);
  // Costs and their sums; without smoothing no volume is kept.
  const std::size_t volumes = configuration.sweep.smoothing == sweep::Smoothing::none
                                  ? 0
                                  : 2 * (static_cast<std::size_t>(configuration.sweep.volume_limit_mib) << 20);
  plan.tile_bytes = width * width * kBytesPerCell + volumes;

  const auto decoding = static_cast<std::size_t>(threads * kDecodingOverhead * static_cast<double>(largest_photo));
  const std::size_t photos_of_a_tile = static_cast<std::size_t>(configuration.views.max_views) * largest_photo;
  const auto needed = [&](int tiles) {
    const std::size_t photos = std::min(all_photos, static_cast<std::size_t>(tiles) * photos_of_a_tile);
    return plan.program_bytes + decoding + static_cast<std::size_t>(tiles) * plan.tile_bytes + photos;
  };
  plan.tiles_in_flight = std::clamp(threads, 1, kMostTilesInFlight);
  while (plan.tiles_in_flight > 1 && needed(plan.tiles_in_flight) > limit_bytes) --plan.tiles_in_flight;
  if (needed(1) > limit_bytes)
    throw Error(
        ErrorKind::memory_plan,
        "--memory allows " + std::to_string(limit_bytes / kMiB) + " MiB, but one tile of " +
            std::to_string(configuration.tiles.cells) + " x " + std::to_string(configuration.tiles.cells) +
            " cells with up to " + std::to_string(configuration.views.max_views) + " photographs needs " +
            std::to_string(needed(1) / kMiB + 1) +
            " MiB: allow that much, or set [sweep] volume_limit_mib, [tiles] cells or [views] max_views lower.");
  const auto tiles = static_cast<std::size_t>(plan.tiles_in_flight);
  plan.photo_cache_bytes = std::min(all_photos, limit_bytes - plan.program_bytes - decoding - tiles * plan.tile_bytes);
  return plan;
}

}  // namespace skysweep::pipeline
