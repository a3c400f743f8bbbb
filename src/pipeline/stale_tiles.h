// SPDX-License-Identifier: Apache-2.0
// What a run has to do: which tiles of the map are stale, which only need a word in the catalogue, and which have to
// go.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/executor.h"
#include "pipeline/coverage.h"
#include "pipeline/map_records.h"
#include "pipeline/tile_check.h"

namespace skysweep::pipeline {

struct StaleTile {
  tiles::TileKey key;
  std::vector<const index::ImageRecord*> candidates;
  std::string candidates_digest;
  std::string why;
  bool damaged = false;
  bool known = false;  // the catalogue had a row for it
};

struct WorkList {
  std::vector<StaleTile> stale;         // along a space-filling curve
  std::vector<index::TileRecord> told;  // rows of fresh tiles that the catalogue should hold instead of its own
  std::vector<tiles::TileKey> gone;     // on record or on disk, but touched by too few photographs
  int fresh = 0;                        // of those asked for
};

// Looks at the tiles that meet `area` (all, if none is given), and at all that have files without a row or turned out
// to be unreadable. `records` null: a project that is yet to be made.
WorkList find_work(const Coverage& coverage, const TileChecker& checker, const MapRecords* records,
                   const tiles::TileStore& store, const std::optional<Box2d>& area, Executor& executor);

// The same for these tiles only: those that photographs touch which came or went since the last look.
WorkList find_work_among(std::vector<tiles::TileKey> keys, const Coverage& coverage, const TileChecker& checker,
                         const MapRecords& records, const tiles::TileStore& store, const std::optional<Box2d>& area,
                         Executor& executor);

}  // namespace skysweep::pipeline
