// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_scheduler.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <set>

#include "core/error.h"
#include "pipeline/coverage.h"
#include "pipeline/disk_need.h"
#include "pipeline/map_parents.h"
#include "pipeline/photographs.h"
#include "pipeline/stale_tiles.h"
#include "pipeline/tile_digest.h"
#include "pipeline/tile_job.h"
#include "pipeline/unknown_tiles.h"
#include "raster/file_stamp.h"

namespace skysweep::pipeline {
namespace {

using Clock = std::chrono::steady_clock;
using FailedPhotographs = std::map<std::string, std::string>;  // name and reason

index::TileRecord record_of(const StaleTile& tile, const TileOutcome& outcome, const MapUpdate& update,
                            double seconds) {
  index::TileRecord record;
  record.name = tile.key.name();
  record.level = tile.key.level;
  record.extent = update.settings.lattice.extent(tile.key);
  record.input_digest = outcome.input_digest;
  record.candidates_digest = tile.candidates_digest;
  record.views = outcome.views;
  for (const std::string& view : outcome.views)
    record.view_digests.push_back(view_digest(**std::find_if(tile.candidates.begin(), tile.candidates.end(),
                                                             [&](const auto* image) { return image->name == view; })));
  record.valid_share = outcome.valid_share;
  if (outcome.heights) {
    record.z_low = outcome.heights->z_low;
    record.z_high = outcome.heights->z_high;
  }
  record.seconds = seconds;
  note_files(update.store, tile.key, record);
  return record;
}

// One pass over the stale tiles. Returns the photographs that could not be decoded, with their reasons.
class Pass {
 public:
  Pass(MapUpdate& update, RunSummary& summary, Progress& progress, const std::atomic<bool>& stop)
      : update_(update), summary_(summary), progress_(progress), stop_(stop) {}

  FailedPhotographs run(const std::vector<StaleTile>& stale, TbbExecutor& executor) {
    progress_.begin("tiles", static_cast<int>(stale.size()));
    executor.for_each_in_order(static_cast<int>(stale.size()), summary_.memory.tiles_in_flight, [&](int i) {
      if (stop_) return;
      compute(stale[i], executor);
      progress_.advance();
    });
    return std::move(failed_photographs_);
  }

  const UnknownTiles& unknown() const { return unknown_; }

 private:
  void compute(const StaleTile& tile, Executor& executor) {
    const auto start = Clock::now();
    try {
      const TileOutcome outcome = compute_tile(tile.key, tile.candidates, update_.settings, update_.photos, executor);
      if (outcome.empty())
        remove(tile.key);
      else
        update_.store.write(tile.key, outcome.tile, outcome.input_digest);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      const index::TileRecord record = record_of(tile, outcome, update_, seconds);
      const std::lock_guard lock(mutex_);
      update_.records.put({record});
      update_.mosaics.write_now_and_then(update_.records);
      ++summary_.tiles_computed;
      summary_.tiles_empty += outcome.empty();
      summary_.cells_measured += outcome.cells_measured;
      summary_.cells_filled += outcome.cells_filled;
      summary_.samples += outcome.samples;
      unknown_.add(outcome);
    } catch (const PhotographFailed& failed) {
      if (const auto path = update_.request.images / failed.name(); !raster::file_stamp(path))
        throw photograph_vanished(path);
      const std::lock_guard lock(mutex_);
      failed_photographs_[failed.name()] = failed.what();
    }
  }

  void remove(tiles::TileKey key) {
    const std::lock_guard lock(mutex_);
    update_.mosaics.write_without(update_.records, {key});
    update_.store.remove(key);
  }

  MapUpdate& update_;
  RunSummary& summary_;
  Progress& progress_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  FailedPhotographs failed_photographs_;
  UnknownTiles unknown_;
};

void refuse(std::vector<index::ImageRecord>& images, const FailedPhotographs& failed, Progress& progress) {
  for (index::ImageRecord& image : images) {
    const auto found = failed.find(image.name);
    if (found == failed.end()) continue;
    image.status = index::ImageStatus::refused;
    image.reason = found->second;
    progress.warn(image.name + ": " + image.reason);
  }
}

// A photograph that could not be decoded last time is tried first, not when half the map has been computed with it.
void retry_refused_ones(MapUpdate& update, Progress& progress) {
  std::map<std::string, std::string> refused_content;
  for (const index::ImageRecord& image : update.known_images)
    if (image.status == index::ImageStatus::refused) refused_content[image.name] = image.content_digest;
  FailedPhotographs failed;
  for (const index::ImageRecord& image : update.images) {
    const auto found = refused_content.find(image.name);
    if (image.status != index::ImageStatus::used || found == refused_content.end()) continue;
    if (found->second != image.content_digest) continue;
    try {
      update.photos.get(image.name);
    } catch (const Error& error) {
      if (const auto path = update.request.images / image.name; !raster::file_stamp(path))
        throw photograph_vanished(path);
      failed[image.name] = error.what();
    }
  }
  refuse(update.images, failed, progress);
}

// What the catalogue does not hold yet goes in, what this run no longer finds goes out.
void record_images(MapUpdate& update, Progress& progress) {
  std::map<std::string, const index::ImageRecord*> known;
  for (const index::ImageRecord& image : update.known_images) known[image.name] = &image;
  std::vector<index::ImageRecord> changed;
  for (const index::ImageRecord& image : update.images) {
    const auto found = known.find(image.name);
    if (found == known.end() || !(*found->second == image)) changed.push_back(image);
    if (found != known.end()) known.erase(found);
  }
  std::vector<std::string> gone;
  for (const auto& [name, image] : known) gone.push_back(name);
  if (!gone.empty())
    progress.warn(std::to_string(gone.size()) + " photographs of earlier runs are not in " +
                  update.request.images.string() + " any more (" + gone.front() +
                  (gone.size() > 1 ? ", ...): " : "): ") + "the map is made without them.");
  if (!changed.empty()) update.catalogue.put_images(changed);
  if (!gone.empty()) update.catalogue.remove_images(gone);
  update.known_images = update.images;
}

void remove_tiles(MapUpdate& update, const std::vector<tiles::TileKey>& gone) {
  if (gone.empty()) return;
  update.mosaics.write_without(update.records, gone);
  for (const tiles::TileKey key : gone) update.store.remove(key);
  update.records.remove(gone);
}

void say_why(const std::vector<StaleTile>& stale, Progress& progress) {
  for (const StaleTile& tile : stale) {
    const std::string sentence = "The tile " + tile.key.name() + " is stale: " + tile.why + ".";
    if (tile.damaged)
      progress.warn(sentence);
    else if (tile.known)
      progress.note(sentence);
  }
}

// The border of every map has such tiles; a map of nothing else is worth a warning.
void say_what_is_unknown(const UnknownTiles& unknown, bool whole_map, Progress& progress) {
  const std::string sentence = unknown.sentence();
  if (sentence.empty()) return;
  whole_map&& unknown.count() == unknown.looked_at ? progress.warn(sentence) : progress.note(sentence);
}

// Tiles that the failed photographs were to serve; from now on they have to do without.
std::vector<tiles::TileKey> take_out(const FailedPhotographs& failed, const std::vector<index::ImageRecord>& images,
                                     Coverage& coverage) {
  std::vector<tiles::TileKey> keys;
  for (const index::ImageRecord& image : images) {
    if (!failed.contains(image.name)) continue;
    const std::vector<tiles::TileKey> touched = coverage.touched(image);
    keys.insert(keys.end(), touched.begin(), touched.end());
    coverage.remove(image.name);
  }
  return keys;
}

// Level 0: until no photograph fails any more.
void update_finest(MapUpdate& update, RunSummary& summary, TbbExecutor& executor, Progress& progress,
                   const std::atomic<bool>& stop) {
  record_images(update, progress);
  Coverage coverage(update.images, update.settings);
  WorkList work = find_work(coverage, update.checker, &update.records, update.store, update.request.area, executor);
  const int kept = work.fresh;
  if (summary.tiles_kept < 0) summary.tiles_kept = kept;
  for (;;) {
    require_disk_space(update.paths.folder, disk_bytes(work.stale.size(), update.settings));
    update.records.put(work.told);
    summary.tiles_removed += static_cast<int>(work.gone.size());
    remove_tiles(update, work.gone);
    say_why(work.stale, progress);
    Pass pass(update, summary, progress, stop);
    const FailedPhotographs failed = pass.run(work.stale, executor);
    if (failed.empty() || stop) return say_what_is_unknown(pass.unknown(), kept == 0, progress);
    const std::vector<tiles::TileKey> keys = take_out(failed, update.images, coverage);
    refuse(update.images, failed, progress);
    record_images(update, progress);
    work = find_work_among(keys, coverage, update.checker, update.records, update.store, update.request.area, executor);
  }
}

}  // namespace

void update_map(MapUpdate& update, RunSummary& summary, TbbExecutor& executor, Progress& progress,
                const std::atomic<bool>& stop) {
  retry_refused_ones(update, progress);
  summary.tiles_kept = -1;
  for (;;) {
    update_finest(update, summary, executor, progress, stop);
    progress.begin("parents", 1);
    const ParentsOutcome parents = update_map_parents(update.records, update.store, update.checker, executor, progress);
    progress.advance();
    summary.parents_written += parents.written;
    summary.quadrants_made += parents.quadrants;
    if (parents.unreadable.empty() || stop) break;
  }
  update.mosaics.write(update.records);
  summary.map_digest = update.records.digest();
  summary.interrupted = stop;
}

}  // namespace skysweep::pipeline
