// SPDX-License-Identifier: Apache-2.0
// Outlines of islands: a Koch curve whose bumps vary in size and, now and then, turn inwards (the classic Koch-curve
// outlines; Koch 1904).
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace skysweep::scene {

// A closed polygon, counter-clockwise, that crosses itself nowhere: 3 x 4^depth corners, on a triangle whose corners
// lie `radius_m` from `center`.
std::vector<Vec2d> koch_outline(Vec2d center, double radius_m, int depth, std::uint64_t seed);

}  // namespace skysweep::scene
