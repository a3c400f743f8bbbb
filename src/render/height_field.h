// SPDX-License-Identifier: Apache-2.0
// The surface of a map, or of a window of it, as one array of heights that rays can be cast at. Every cell is one of
// three kinds: known; a hole, which is enclosed by known cells and gets a stand-in height between theirs, so that it is
// drawn as what it is and never as a cliff; or outside, of which nothing is there to be hit.
#pragma once

#include <cstdint>

#include "core/array2d.h"
#include "core/box.h"
#include "core/vec.h"

namespace skysweep::render {

enum class CellKind : std::uint8_t { outside = 0, known = 1, hole = 2 };

struct HeightField {
  Vec2d north_west_m;       // outer corner of the north-west cell, map coordinates
  double cell_m = 1;        // side of a cell
  Array2d<float> height_m;  // row 0 = north; NaN outside
  Array2d<CellKind> kind;   // of the same size

  // Map coordinates to cells from the north-west corner, x eastwards and y southwards; z stays metres. The corner is
  // taken off in double first, so that coordinates of 10^7 m keep their last micrometre.
  Vec3d cells_from_map(Vec3d p) const {
    return {(p.x - north_west_m.x) / cell_m, (north_west_m.y - p.y) / cell_m, p.z};
  }
  Vec3d map_from_cells(Vec3d p) const { return {north_west_m.x + p.x * cell_m, north_west_m.y - p.y * cell_m, p.z}; }
};

// `height_m`: NaN where nothing is known. No-data cells that are connected with the border of the array (over the
// sides of cells) are outside, all others holes.
HeightField make_height_field(Vec2d north_west_m, double cell_m, Array2d<float> height_m);

// From the cells' sides and the heights of known cells; `share` of the lowest and of the highest are left out, so that
// a spike does not push the picture away. Empty if no cell is known.
Box3d bounds(const HeightField& field, double share);

// The same surface with heights above `base_m` multiplied.
HeightField exaggerated(HeightField field, double factor, double base_m);

}  // namespace skysweep::render
