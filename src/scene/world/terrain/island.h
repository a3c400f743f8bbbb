// SPDX-License-Identifier: Apache-2.0
// An island in the sea: land that rises from a fractal coast, and a bed that falls from it.
#pragma once

#include <cstdint>

#include "scene/terrain.h"
#include "scene/world/terrain/height_grid.h"

namespace skysweep::scene {

// The closed form is the lattice (100 points to a radius), interpolated: the coast is exact to about half its spacing.
HeightGrid build_island(const IslandTerrain& shape, std::uint64_t seed);

// Distance from a closed polygon, positive inside, at the points of a lattice (row 0 in the south).
Array2d<double> signed_distances(const std::vector<Vec2d>& polygon, Vec2d first, double spacing_m, int width,
                                 int height);

}  // namespace skysweep::scene
