// SPDX-License-Identifier: Apache-2.0
// Coarser levels of the map from finer ones: each cell from 2 x 2 cells below it (METHODS section 3).
#pragma once

#include <array>
#include <vector>

#include "tiles/tile_store.h"

namespace skysweep::tiles {

// A parent from its (at most) four children, in the order south-west, south-east, north-west, north-east; a null child
// is all no-data. dem: mean of the known cells; dem_max: the highest; colour: mean of the known ones; confidence: root
// mean square of the known ones; mask: measured if any is, else filled, else planar, else none.
Tile merge_children(const std::array<const Tile*, 4>& children, int tile_cells);

// Rebuilds every parent of the `changed` level-0 tiles, level by level, and the top tile; removes tiles of levels above
// the plan's highest. `store` then holds levels 0..L-1 for all its level-0 tiles. The digest of a parent is made of its
// children's. Returns the keys written.
std::vector<TileKey> rebuild_parents(const TileStore& store, const std::vector<TileKey>& changed);

}  // namespace skysweep::tiles
