// SPDX-License-Identifier: Apache-2.0
// Brings a project's tiles up to date: decides which are stale, computes those, rebuilds their parents.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "index/catalogue.h"
#include "pipeline/photo_cache.h"
#include "pipeline/progress.h"
#include "pipeline/session.h"
#include "pipeline/tbb_executor.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

struct MapUpdate {
  const tiles::TileStore& store;
  index::Catalogue& catalogue;
  const ProjectSettings& settings;
  const std::optional<Box2d>& area;
  std::vector<index::ImageRecord>& images;  // photographs that turn out to be unreadable become refused
  PhotoCache& photos;
};

// Tiles whose digest is unchanged are kept. A photograph that cannot be decoded is refused, and the tiles it would have
// served are computed without it. Fills the counts of `summary`.
void update_map(MapUpdate& update, RunSummary& summary, TbbExecutor& executor, Progress& progress,
                const std::atomic<bool>& stop);

}  // namespace skysweep::pipeline
