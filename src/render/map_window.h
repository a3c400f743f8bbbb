// SPDX-License-Identifier: Apache-2.0
// A part of the map, read from its tiles, at the finest level that fits.
#pragma once

#include <cstdint>
#include <optional>

#include "core/array2d.h"
#include "core/box.h"
#include "core/color.h"
#include "tiles/tile_store.h"

namespace skysweep::render {

struct MapWindow {
  int level = 0;
  Vec2d north_west_m;       // outer corner of the north-west cell
  double cell_m = 1;        // at this level
  Array2d<float> height_m;  // row 0 = north; NaN = unknown
  Array2d<Rgba8> color;     // alpha 0 = unknown
  Array2d<float> sigma_m;   // NaN = unknown
};

// The smallest window that holds all known heights of the area (of the whole map without one), at the finest level at
// which the tiles that it touches have at most `most_cells` cells. Throws Error(bad_input) if nothing is known there or
// a tile is damaged, Error(memory_plan) if no level is coarse enough.
MapWindow read_map_window(const tiles::TileStore& store, const std::optional<Box2d>& area, std::int64_t most_cells);

}  // namespace skysweep::render
