// SPDX-License-Identifier: Apache-2.0
// Brings a project's map up to date with its photographs: decides which tiles are stale, computes those, removes those
// that no photograph touches any more, and makes what changed of the coarser levels.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "index/catalogue.h"
#include "pipeline/live_mosaics.h"
#include "pipeline/map_records.h"
#include "pipeline/photo_cache.h"
#include "pipeline/progress.h"
#include "pipeline/session.h"
#include "pipeline/tbb_executor.h"
#include "pipeline/tile_check.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

struct MapUpdate {
  const ProjectPaths& paths;
  const tiles::TileStore& store;
  index::Catalogue& catalogue;
  MapRecords& records;
  const ProjectSettings& settings;
  const TileChecker& checker;
  LiveMosaics& mosaics;
  const RunRequest& request;
  std::vector<index::ImageRecord> known_images;  // as the catalogue held them
  std::vector<index::ImageRecord>& images;       // photographs that turn out to be unreadable become refused
  PhotoCache& photos;
};

// Tiles whose inputs are unchanged are kept. A photograph that cannot be decoded is refused, and the tiles it would
// have served are computed without it; one that is gone ends the run. Fills the counts of `summary`.
void update_map(MapUpdate& update, RunSummary& summary, TbbExecutor& executor, Progress& progress,
                const std::atomic<bool>& stop);

}  // namespace skysweep::pipeline
