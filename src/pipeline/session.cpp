// SPDX-License-Identifier: Apache-2.0
#include "pipeline/session.h"

#include <algorithm>

#include "core/error.h"
#include "index/catalogue.h"
#include "pipeline/coverage.h"
#include "pipeline/ground_estimate.h"
#include "pipeline/lattice_limits.h"
#include "pipeline/open_project.h"
#include "pipeline/photographs.h"
#include "pipeline/tbb_executor.h"
#include "pipeline/tile_scheduler.h"
#include "raster/atomic_file.h"
#include "settings/preset.h"
#include "sweep/backend.h"
#include "tiles/pyramid.h"

namespace skysweep::pipeline {
namespace {

void report_refusals(const std::vector<index::ImageRecord>& records, Progress& progress) {
  for (const std::string& reason : refusals(records)) progress.warn(reason);
}

// At most: nothing compresses, every tile is full, and the mosaics repeat level 0.
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

void set_footprints(std::vector<index::ImageRecord>& records, const SearchRange& search) {
  for (index::ImageRecord& record : records)
    if (record.model.width_px > 0) record.footprint = ground_footprint(record, search);
}

// While it lives, what the GPU could not do reaches the user.
class GpuTroubleAsWarnings {
 public:
  explicit GpuTroubleAsWarnings(Progress& progress) {
    sweep::listen_to_gpu_trouble([&progress](const std::string& sentence) { progress.warn(sentence); });
  }
  ~GpuTroubleAsWarnings() { sweep::listen_to_gpu_trouble(nullptr); }
};

}  // namespace

RunSummary run(const RunRequest& request, Progress& progress, const std::atomic<bool>& stop) {
  const ProjectPaths paths(request.project);
  TbbExecutor executor(request.threads);
  RunSummary summary;
  const GpuTroubleAsWarnings warnings(progress);

  const ProjectChoice choice = choose_project(request, paths);
  PhotographSet photographs =
      collect_photographs(request.images, request.poses, request.origin, choice.configuration.photographs, executor);
  for (const std::string& note : photographs.notes) progress.note(note);
  for (const std::string& warning : photographs.warnings) progress.warn(warning);
  report_refusals(photographs.records, progress);

  summary.memory = plan_memory(request.memory_bytes.value_or(default_memory_limit()), photographs.records,
                               choice.configuration, request.threads);
  PhotoCache photos(request.images, summary.memory.photo_cache_bytes, choice.configuration.sweep.normalization());
  summary.settings = choice.existing ? *choice.existing
                                     : new_project_settings(request, choice.configuration, photographs.records, photos,
                                                            executor, progress);
  require_countable_lattice(photographs.records, summary.settings);
  for (const std::string& warning : resolution_warnings(photographs.records, summary.settings)) progress.warn(warning);
  for (const std::string& warning : scatter_warnings(photographs.records)) progress.warn(warning);
  use_recorded_engine(summary.settings);
  set_footprints(photographs.records, summary.settings.search);

  const std::vector<tiles::TileKey> planned = Coverage(photographs.records, summary.settings).tiles(request.area);
  summary.tiles_planned = static_cast<int>(planned.size());
  summary.disk_bytes_needed = disk_bytes(planned.size(), summary.settings);
  if (!request.dry_run) {
    require_disk_space(request.project, summary.disk_bytes_needed);
    if (!choice.existing) make_project(paths, summary.settings, request.fresh);
    index::Catalogue catalogue(paths.catalogue(), summary.settings.crs_wkt);
    const tiles::TileStore store = open_store(paths, summary.settings);
    MapUpdate update{store, catalogue, summary.settings, request.area, photographs.records, photos};
    update_map(update, summary, executor, progress, stop);
  }
  summary.images = std::move(photographs.records);
  summary.photographs_decoded = photos.decoded();
  return summary;
}

}  // namespace skysweep::pipeline
