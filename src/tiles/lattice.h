// SPDX-License-Identifier: Apache-2.0
// The unbounded lattice of tiles and height planes, anchored at the world's origin (Feldmann 2013). It is fixed
// when a project is made and never moves.
#pragma once

#include "core/box.h"
#include "core/vec.h"
#include "tiles/tile_key.h"

namespace skysweep::tiles {

struct Lattice {
  int tile_cells = 512;  // T: cells along a side of a tile
  double cell_m = 1;     // side of a cell at level 0
  double dz_m = 1;       // distance of height planes: z = k dz

  // Side of a cell and of a tile at a level (not for `top`).
  double cell_size_m(int level) const { return cell_m * static_cast<double>(1LL << level); }
  double tile_size_m(int level) const { return tile_cells * cell_size_m(level); }

  // South-west corner: (x T) g 2^l, the product of integers taken first.
  Vec2d south_west_corner(TileKey key) const;
  Vec2d north_west_corner(TileKey key) const;
  Box2d extent(TileKey key) const;

  // floor(coordinate / tile size), exact at the borders: the index of a tile's own south-west corner is the tile's.
  int index_at(int level, double coordinate) const;
  TileKey key_at(int level, Vec2d position) const {
    return {level, index_at(level, position.x), index_at(level, position.y)};
  }

  friend bool operator==(const Lattice&, const Lattice&) = default;
};

// The levels that serve a set of level-0 tiles whose indices span [min_x, max_x] x [min_y, max_y]: the top covers the
// at most 2 x 2 tiles of the highest regular level, L-2.
struct LevelPlan {
  int highest_regular_level = 0;  // L - 2
  TileKey top_south_west;         // the south-west one of the (at most) 2 x 2 tiles below the top
  int level_count() const { return highest_regular_level + 2; }  // L
};
LevelPlan plan_levels(int min_x, int min_y, int max_x, int max_y);

}  // namespace skysweep::tiles
