// SPDX-License-Identifier: Apache-2.0
// Coarser levels of the map from finer ones: each cell from 2 x 2 cells below it.
#pragma once

#include <array>
#include <vector>

#include "core/executor.h"
#include "tiles/tile_store.h"

namespace skysweep::tiles {

// A parent from its (at most) four children, in the order south-west, south-east, north-west, north-east; a null child
// is all no-data. dem: mean of the known cells; dem_max: the highest; colour: mean of the known ones; confidence: root
// mean square of the known ones; mask: measured if any is, else filled, else planar, else none.
Tile merge_children(const std::array<const Tile*, 4>& children, int tile_cells);

// Rebuilds every parent of the `changed` level-0 tiles (written, or removed), level by level, and the top tile; makes
// those that are missing, because the map has grown to a higher level; removes parents that have no children left and
// tiles of levels above the plan's highest. `store` then holds levels 0..L-1 for all its level-0 tiles, with the same
// bytes whatever the order in which they came. The digest of a parent is made of its children's. The tiles of a level
// are independent and run on the executor. Returns the keys written, finest level first.
std::vector<TileKey> rebuild_parents(const TileStore& store, const std::vector<TileKey>& changed, Executor& executor);
std::vector<TileKey> rebuild_parents(const TileStore& store, const std::vector<TileKey>& changed);

// For the first start after a crash: what to give to rebuild_parents as `changed` so that parents written before their
// children's last change become right again. Reads the labels of all tiles.
std::vector<TileKey> find_outdated(const TileStore& store);

}  // namespace skysweep::tiles
