// SPDX-License-Identifier: Apache-2.0
// The class map of the truth: which kind of surface lies in each cell, and which cells lie beside a building's edge.
#pragma once

#include <cstdint>

#include "core/array2d.h"
#include "scene/world/surface_class.h"

namespace skysweep::scene {

// What the raster says of its codes.
constexpr const char* kClassesContent = "surface class: 1 ground, 2 roof, 3 facade edge, 4 tree, 5 water, 6 thin";

// Turns ground and roof into facade_edge where the cell's centre lies within `reach_m` of a height step of a building:
// of the border between two neighbouring cells, both ground, roof, facade or water and at least one of them roof,
// whose heights differ by more than half a metre plus what a roof of 63 degrees rises from cell to cell. Steps outside
// the map do not count.
void mark_facade_edges(const Array2d<float>& height, double cell_m, double reach_m, Array2d<std::uint8_t>& classes);

}  // namespace skysweep::scene
