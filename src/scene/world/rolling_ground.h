// SPDX-License-Identifier: Apache-2.0
// Where rays meet rolling ground, all rays of a batch at once: most rays of a photograph do, and its sines are what
// that costs.
#pragma once

#include <array>

#include "scene/world/ray.h"
#include "scene/world/terrain/waves.h"

namespace skysweep::scene {

struct GroundHits {
  alignas(64) std::array<double, kRayBatch> x, y, z;     // place on the ray
  alignas(64) std::array<double, kRayBatch> nx, ny, nz;  // unit normal of the ground there
};

// One step of Newton's method from origin + t x direction of each lane, which has to lie millimetres from the ground,
// with `waves` (null: the plane z = 0) in closed form and double precision. What comes out of lanes that hit something
// else means nothing.
void meet_rolling_ground(const Waves* waves, const RayLanes& rays, const float* t, GroundHits& out);

}  // namespace skysweep::scene
