// SPDX-License-Identifier: Apache-2.0
#include "pipeline/session.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "pipeline/coverage.h"
#include "pipeline/disk_need.h"
#include "pipeline/ground_estimate.h"
#include "pipeline/lattice_limits.h"
#include "pipeline/open_project.h"
#include "pipeline/photographs.h"
#include "pipeline/project_lock.h"
#include "pipeline/recover_catalogue.h"
#include "pipeline/removals.h"
#include "pipeline/stale_tiles.h"
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

// Nobody else writes while a run does; a dry run disturbs nobody.
std::optional<ProjectLock> lock_for(const RunRequest& request) {
  if (request.dry_run) return std::nullopt;
  return ProjectLock(request.project);
}

// The catalogue for looking only; nothing, with a warning, if it is damaged.
std::optional<index::Catalogue> look_at_catalogue(const ProjectPaths& paths, Progress& progress) {
  std::error_code error;
  if (!std::filesystem::exists(paths.catalogue(), error)) return std::nullopt;
  try {
    return index::Catalogue::open_existing(paths.catalogue());
  } catch (const Error& damage) {
    progress.warn(std::string(damage.what()) + "; a run without --dry-run does so.");
    return std::nullopt;
  }
}

std::set<std::string> removals_of(const RunRequest& request, const ProjectPaths& paths, bool exists,
                                  const std::vector<index::ImageRecord>& photographs) {
  const std::set<std::string> before = exists ? read_removals(paths) : std::set<std::string>{};
  return changed_removals(before, photographs, request.remove, request.restore);
}

// What earlier runs left.
struct EarlierRuns {
  std::optional<OpenCatalogue> open;          // of a run
  std::optional<index::Catalogue> looked_at;  // of a dry run
  std::vector<index::ImageRecord> images;     // none when everything is to be read
};

EarlierRuns look_at_earlier_runs(const RunRequest& request, const ProjectChoice& choice, const ProjectPaths& paths,
                                 Progress& progress) {
  EarlierRuns earlier;
  if (!choice.existing) return earlier;
  if (request.dry_run) {
    earlier.looked_at = look_at_catalogue(paths, progress);
    if (earlier.looked_at) earlier.images = earlier.looked_at->images();
  } else {
    raster::remove_temporary_files(paths.folder);
    earlier.open = open_catalogue(paths, choice.existing->crs_wkt, progress);
    earlier.images = earlier.open->images;
  }
  if (request.verify) earlier.images.clear();
  return earlier;
}

PhotographSet photographs_of(const RunRequest& request, const Configuration& configuration, Executor& executor,
                             const std::vector<index::ImageRecord>& known) {
  const PhotographOptions& options = configuration.photographs;
  if (request.given)
    return inspect_photographs(request.images, request.given->names, request.given->poses, request.origin, options,
                               executor, known);
  return collect_photographs(request.images, request.poses, request.origin, options, executor, known);
}

// What a run would do, without a trace.
void plan_only(const RunRequest& request, const ProjectPaths& paths, const Coverage& coverage,
               std::optional<index::Catalogue>& catalogue, RunSummary& summary, Executor& executor) {
  const tiles::TileStore store = open_store(paths, summary.settings);
  const TileChecker checker(summary.settings, store, request.verify);
  std::optional<MapRecords> records;
  if (catalogue) records.emplace(*catalogue);
  const WorkList work = find_work(coverage, checker, records ? &*records : nullptr, store, request.area, executor);
  summary.tiles_stale = static_cast<int>(work.stale.size());
  summary.tiles_kept = work.fresh;
  summary.tiles_removed = static_cast<int>(work.gone.size());
  summary.disk_bytes_needed = disk_bytes(work.stale.size(), summary.settings);
}

}  // namespace

RunSummary run(const RunRequest& request, Progress& progress, const std::atomic<bool>& stop) {
  const ProjectPaths paths(request.project);
  TbbExecutor executor(request.threads);
  RunSummary summary;
  const GpuTroubleAsWarnings warnings(progress);

  const std::optional<ProjectLock> lock = lock_for(request);
  const ProjectChoice choice = choose_project(request, paths);
  EarlierRuns earlier = look_at_earlier_runs(request, choice, paths, progress);
  PhotographSet photographs = photographs_of(request, choice.configuration, executor, earlier.images);
  for (const std::string& note : photographs.notes) progress.note(note);
  for (const std::string& warning : photographs.warnings) progress.warn(warning);
  report_refusals(photographs.records, progress);
  const std::set<std::string> removed = removals_of(request, paths, choice.existing.has_value(), photographs.records);
  mark_removed(photographs.records, removed);

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

  {
    const Coverage coverage(photographs.records, summary.settings);
    summary.tiles_planned = static_cast<int>(coverage.tiles(request.area).size());
    if (request.dry_run) plan_only(request, paths, coverage, earlier.looked_at, summary, executor);
  }
  if (!request.dry_run) {
    if (!choice.existing) {
      require_disk_space(request.project, disk_bytes(summary.tiles_planned, summary.settings));
      make_project(paths, summary.settings, request.fresh);
      earlier.open = open_catalogue(paths, summary.settings.crs_wkt, progress);
    }
    if (!request.remove.empty() || !request.restore.empty()) write_removals(paths, removed);
    const tiles::TileStore store = open_store(paths, summary.settings);
    const TileChecker checker(summary.settings, store, request.verify);
    LiveMosaics mosaics(paths, store);
    MapUpdate update{paths,
                     store,
                     *earlier.open->file,
                     *earlier.open->tiles,
                     summary.settings,
                     checker,
                     mosaics,
                     request,
                     earlier.open->images,
                     photographs.records,
                     photos};
    update_map(update, summary, executor, progress, stop);
  }
  summary.images = std::move(photographs.records);
  summary.photographs_decoded = photos.decoded();
  return summary;
}

}  // namespace skysweep::pipeline
