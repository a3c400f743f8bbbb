// SPDX-License-Identifier: Apache-2.0
// Coarser levels of the map from finer ones: each cell from 2 x 2 cells below it. Only quadrants of parents whose child
// has changed are made again (Feldmann 2013).
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/executor.h"
#include "tiles/tile_store.h"

namespace skysweep::tiles {

// A parent from its (at most) four children, in the order south-west, south-east, north-west, north-east; a null child
// is all no-data. dem: mean of the known cells; dem_max: the highest; colour: mean of the known ones; confidence: root
// mean square of the known ones; mask: measured if any is, else filled, else planar, else none.
Tile merge_children(const std::array<const Tile*, 4>& children, int tile_cells);

// The same piece by piece: a parent of which nothing is known, and one quadrant of it from its child (null: no-data).
Tile empty_parent(int tile_cells);
void put_quadrant(Tile& parent, int quadrant, const Tile* child);

// What a parent was made from. Depends on nothing but the digests of its children and where they lie.
struct ParentState {
  std::string digest;
  // Name and digest of each child, in the order of merge_children; both empty where there is none.
  struct Child {
    std::string name, digest;
    friend bool operator==(const Child&, const Child&) = default;
  };
  std::array<Child, 4> children;
};

// What is on disk.
struct PyramidState {
  std::map<TileKey, std::string> finest;   // level-0 tiles with files, and their digests
  std::map<TileKey, ParentState> parents;  // whole ones only; a digest without children: all of it may be made again
};

// As the labels of the files tell, which means opening all of them.
PyramidState read_pyramid_state(const TileStore& store);

struct PyramidChanges {
  std::vector<TileKey> written;     // finest level first
  std::vector<TileKey> removed;     // without children left, or of levels that the map no longer has
  std::vector<TileKey> unreadable;  // tiles needed for a parent that could not be read: nothing above them was made
  int quadrants_made = 0;
};

// Called after each level with the parents written.
using PyramidListener = std::function<void(const std::map<TileKey, ParentState>& written)>;

// Makes, level by level and then the top, every parent whose children are not those it was made from, and removes those
// without children: the store then holds levels 0..L-1 for its level-0 tiles, with the same bytes whatever it held
// before. The tiles of a level are independent and run on the executor.
PyramidChanges update_parents(const TileStore& store, const PyramidState& state, Executor& executor,
                              const PyramidListener& listener);

// The same without any record but the files themselves.
PyramidChanges update_parents(const TileStore& store);

// Where a tile lies; the top is as large as two tiles of the level below it.
LevelPlan plan_for(const std::map<TileKey, std::string>& finest);

}  // namespace skysweep::tiles
