// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_scheduler.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <set>

#include "core/error.h"
#include "pipeline/coverage.h"
#include "pipeline/tile_job.h"
#include "pipeline/unknown_tiles.h"
#include "tiles/pyramid.h"

namespace skysweep::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

struct StaleTile {
  tiles::TileKey key;
  std::vector<const index::ImageRecord*> candidates;
  std::string digest;
};

// Digests of the tiles as the catalogue knows them: a tile in which nothing could be known has no files.
std::map<std::string, std::string> recorded_digests(const index::Catalogue& catalogue) {
  std::map<std::string, std::string> digests;
  for (const index::TileRecord& tile : catalogue.tiles()) digests[tile.name] = tile.input_digest;
  return digests;
}

bool is_up_to_date(const MapUpdate& update, const StaleTile& tile, const std::map<std::string, std::string>& recorded) {
  const auto found = recorded.find(tile.key.name());
  if (found == recorded.end() || found->second != tile.digest) return false;
  const std::optional<std::string> stored = update.store.input_digest(tile.key);
  return !stored || *stored == tile.digest;
}

index::TileRecord record_of(const StaleTile& tile, const TileOutcome& outcome, const tiles::Lattice& lattice,
                            double seconds) {
  index::TileRecord record;
  record.name = tile.key.name();
  record.level = tile.key.level;
  record.extent = lattice.extent(tile.key);
  record.input_digest = tile.digest;
  record.views = outcome.views;
  record.valid_share = outcome.valid_share;
  if (outcome.heights) {
    record.z_low = outcome.heights->z_low;
    record.z_high = outcome.heights->z_high;
  }
  record.seconds = seconds;
  return record;
}

// One pass over the stale tiles. Returns the photographs that could not be decoded, with their reasons.
class Pass {
 public:
  Pass(MapUpdate& update, RunSummary& summary, Progress& progress, const std::atomic<bool>& stop)
      : update_(update), summary_(summary), progress_(progress), stop_(stop) {}

  std::map<std::string, std::string> run(const std::vector<StaleTile>& stale, TbbExecutor& executor) {
    progress_.begin("tiles", static_cast<int>(stale.size()));
    executor.for_each_in_order(static_cast<int>(stale.size()), summary_.memory.tiles_in_flight, [&](int i) {
      if (stop_) return;
      compute(stale[i], executor);
      progress_.advance();
    });
    return std::move(failed_photographs_);
  }

  const std::vector<tiles::TileKey>& changed() const { return changed_; }
  const UnknownTiles& unknown() const { return unknown_; }

 private:
  void compute(const StaleTile& tile, Executor& executor) {
    const auto start = Clock::now();
    try {
      const TileOutcome outcome = compute_tile(tile.key, tile.candidates, update_.settings, update_.photos, executor);
      if (outcome.empty())
        update_.store.remove(tile.key);
      else
        update_.store.write(tile.key, outcome.tile, tile.digest);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      const std::lock_guard lock(mutex_);
      update_.catalogue.put_tiles({record_of(tile, outcome, update_.settings.lattice, seconds)});
      changed_.push_back(tile.key);
      ++summary_.tiles_computed;
      summary_.tiles_empty += outcome.empty();
      summary_.cells_measured += outcome.cells_measured;
      summary_.cells_filled += outcome.cells_filled;
      summary_.samples += outcome.samples;
      unknown_.add(outcome);
    } catch (const PhotographFailed& failed) {
      const std::lock_guard lock(mutex_);
      failed_photographs_[failed.name()] = failed.what();
    }
  }

  MapUpdate& update_;
  RunSummary& summary_;
  Progress& progress_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::vector<tiles::TileKey> changed_;
  std::map<std::string, std::string> failed_photographs_;
  UnknownTiles unknown_;
};

std::vector<StaleTile> find_stale(const MapUpdate& update, const Coverage& coverage, int& kept) {
  const std::map<std::string, std::string> recorded = recorded_digests(update.catalogue);
  std::vector<StaleTile> stale;
  kept = 0;
  for (const tiles::TileKey key : coverage.tiles(update.area)) {
    StaleTile tile{key, coverage.candidates(key), {}};
    tile.digest = tile_digest(key, tile.candidates, update.settings);
    if (is_up_to_date(update, tile, recorded))
      ++kept;
    else
      stale.push_back(std::move(tile));
  }
  return stale;
}

// Photographs and tiles of an earlier run that this one's photographs do not account for.
std::vector<tiles::TileKey> drop_what_lost_its_photographs(MapUpdate& update, const Coverage& coverage) {
  std::set<std::string> images;
  for (const index::ImageRecord& image : update.images) images.insert(image.name);
  std::vector<std::string> gone_images;
  for (const index::ImageRecord& image : update.catalogue.images())
    if (!images.contains(image.name)) gone_images.push_back(image.name);
  update.catalogue.remove_images(gone_images);

  const std::vector<tiles::TileKey> possible = coverage.tiles(std::nullopt);
  const std::set<tiles::TileKey> keep(possible.begin(), possible.end());
  std::vector<tiles::TileKey> gone;
  std::vector<std::string> gone_names;
  for (const index::TileRecord& tile : update.catalogue.tiles()) {
    const std::optional<tiles::TileKey> key = tiles::TileKey::parse(tile.name);
    if (key && keep.contains(*key)) continue;
    gone_names.push_back(tile.name);
    if (key) gone.push_back(*key);
  }
  for (const tiles::TileKey key : gone) update.store.remove(key);
  update.catalogue.remove_tiles(gone_names);
  return gone;
}

void refuse(std::vector<index::ImageRecord>& images, const std::map<std::string, std::string>& failed,
            Progress& progress) {
  for (index::ImageRecord& image : images) {
    const auto found = failed.find(image.name);
    if (found == failed.end()) continue;
    image.status = index::ImageStatus::refused;
    image.reason = found->second;
    progress.warn(image.name + ": " + image.reason);
  }
}

// The border of every map has such tiles; a map of nothing else is worth a warning.
void say_what_is_unknown(const UnknownTiles& unknown, Progress& progress) {
  const std::string sentence = unknown.sentence();
  if (sentence.empty()) return;
  unknown.count() == unknown.looked_at ? progress.warn(sentence) : progress.note(sentence);
}

// A photograph that could not be decoded last time is tried first, not when half the map has been computed with it.
void retry_refused_ones(MapUpdate& update, Progress& progress) {
  std::map<std::string, std::string> refused_content;
  for (const index::ImageRecord& image : update.catalogue.images())
    if (image.status == index::ImageStatus::refused) refused_content[image.name] = image.content_digest;
  std::map<std::string, std::string> failed;
  for (const index::ImageRecord& image : update.images) {
    const auto found = refused_content.find(image.name);
    if (image.status != index::ImageStatus::used || found == refused_content.end()) continue;
    if (found->second != image.content_digest) continue;
    try {
      update.photos.get(image.name);
    } catch (const Error& error) {
      failed[image.name] = error.what();
    }
  }
  refuse(update.images, failed, progress);
}

}  // namespace

void update_map(MapUpdate& update, RunSummary& summary, TbbExecutor& executor, Progress& progress,
                const std::atomic<bool>& stop) {
  retry_refused_ones(update, progress);
  std::vector<tiles::TileKey> changed = tiles::find_outdated(update.store);
  int kept_before = -1;
  for (;;) {
    update.catalogue.put_images(update.images);
    const Coverage coverage(update.images, update.settings);
    const std::vector<tiles::TileKey> gone = drop_what_lost_its_photographs(update, coverage);
    changed.insert(changed.end(), gone.begin(), gone.end());
    int kept = 0;
    const std::vector<StaleTile> stale = find_stale(update, coverage, kept);
    if (kept_before < 0) kept_before = kept;
    Pass pass(update, summary, progress, stop);
    const std::map<std::string, std::string> failed = pass.run(stale, executor);
    changed.insert(changed.end(), pass.changed().begin(), pass.changed().end());
    if (failed.empty() || stop) {
      say_what_is_unknown(pass.unknown(), progress);
      break;
    }
    refuse(update.images, failed, progress);
  }
  summary.tiles_kept = kept_before;
  progress.begin("parents", 1);
  summary.parents_written = static_cast<int>(tiles::rebuild_parents(update.store, changed, executor).size());
  progress.advance();
  summary.interrupted = stop;
}

}  // namespace skysweep::pipeline
