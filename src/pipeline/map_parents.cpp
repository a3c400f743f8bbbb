// SPDX-License-Identifier: Apache-2.0
#include "pipeline/map_parents.h"

#include <algorithm>

namespace skysweep::pipeline {
namespace {

using index::TileRecord;
using tiles::TileKey;

// What the catalogue and the files say together: parents that are not as they were written do not count.
tiles::PyramidState state_on_disk(MapRecords& records, const TileChecker& checker, Progress& progress) {
  tiles::PyramidState state;
  state.finest = records.finest();
  std::vector<TileRecord> touched;
  std::vector<TileKey> damaged;
  for (const auto& [key, row] : records.rows()) {
    if (key.level == 0) continue;
    TileRecord now = row;
    if (!checker.files_are_as_written(key, now)) {
      progress.warn("The tile " + row.name + " is missing or not as it was written: it is made again.");
      damaged.push_back(key);
      continue;
    }
    if (now.stamp != row.stamp) touched.push_back(now);
    state.parents[key] = parent_of_row(row);
  }
  records.put(touched);
  records.remove(damaged);
  return state;
}

// Parents lose their rows; level-0 tiles keep theirs, which then fit no file and no photographs
// (pipeline/stale_tiles.h).
void forget(const std::vector<TileKey>& keys, MapRecords& records) {
  std::vector<TileRecord> finest;
  std::vector<TileKey> parents;
  for (const TileKey key : keys) {
    if (key.level > 0) {
      parents.push_back(key);
      continue;
    }
    finest.push_back(*records.find(key));
    finest.back().candidates_digest.clear();
    finest.back().checksum = "unreadable";
    finest.back().stamp.clear();
  }
  records.put(finest);
  records.remove(parents);
}

Box2d extent_of(TileKey key, const tiles::Lattice& lattice, const tiles::LevelPlan& plan) {
  if (!key.is_top()) return lattice.extent(key);
  const TileKey south_west = plan.top_south_west;
  const TileKey north_east{south_west.level, south_west.x + 1, south_west.y + 1};
  return {lattice.extent(south_west).min, lattice.extent(north_east).max};
}

}  // namespace

ParentsOutcome update_map_parents(MapRecords& records, const tiles::TileStore& store, const TileChecker& checker,
                                  Executor& executor, Progress& progress) {
  ParentsOutcome outcome;
  // A parent that cannot be read although nothing seemed wrong with it is forgotten, and made again in the next turn.
  for (bool again = true; again && outcome.unreadable.empty();) {
    again = false;
    const tiles::PyramidState state = state_on_disk(records, checker, progress);
    const tiles::LevelPlan plan = state.finest.empty() ? tiles::LevelPlan{} : tiles::plan_for(state.finest);
    const tiles::PyramidChanges changes =
        tiles::update_parents(store, state, executor, [&](const std::map<TileKey, tiles::ParentState>& written) {
          std::vector<TileRecord> rows;
          for (const auto& [key, parent] : written) {
            const int level = key.is_top() ? plan.highest_regular_level + 1 : key.level;
            rows.push_back(row_of_parent(key, level, extent_of(key, store.lattice(), plan), parent));
            note_files(store, key, rows.back());
          }
          records.put(rows);
        });
    records.remove(changes.removed);
    outcome.written += static_cast<int>(changes.written.size());
    outcome.removed += static_cast<int>(changes.removed.size());
    outcome.quadrants += changes.quadrants_made;
    for (const TileKey key : changes.unreadable) {
      progress.warn("The tile " + key.name() + " cannot be read: it is made again.");
      if (key.level == 0)
        outcome.unreadable.push_back(key);
      else
        again = true;
    }
    forget(changes.unreadable, records);
  }
  return outcome;
}

}  // namespace skysweep::pipeline
