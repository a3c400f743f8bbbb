// SPDX-License-Identifier: Apache-2.0
// Brings the coarser levels of a project's map up to date with its level-0 tiles, and the catalogue with them.
#pragma once

#include <vector>

#include "core/executor.h"
#include "pipeline/map_records.h"
#include "pipeline/progress.h"
#include "pipeline/tile_check.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

struct ParentsOutcome {
  int written = 0;
  int quadrants = 0;
  int removed = 0;
  std::vector<tiles::TileKey> unreadable;  // level-0 tiles to compute again before the parents can be finished
};

// Parents whose files are not as they were written are made again, with a warning.
ParentsOutcome update_map_parents(MapRecords& records, const tiles::TileStore& store, const TileChecker& checker,
                                  Executor& executor, Progress& progress);

}  // namespace skysweep::pipeline
