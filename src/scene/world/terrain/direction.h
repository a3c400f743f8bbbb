// SPDX-License-Identifier: Apache-2.0
// Directions in plan, as maps give them.
#pragma once

#include <cmath>
#include <numbers>

#include "core/vec.h"

namespace skysweep::scene {

constexpr double radians(double deg) { return deg * std::numbers::pi / 180; }

// Unit vector (east, north) of an azimuth, clockwise from north.
inline Vec2d direction_of(double azimuth_deg) {
  return {std::sin(radians(azimuth_deg)), std::cos(radians(azimuth_deg))};
}

}  // namespace skysweep::scene
