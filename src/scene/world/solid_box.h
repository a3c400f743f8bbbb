// SPDX-License-Identifier: Apache-2.0
// A box with a level top: most buildings, what stands on roofs, cars.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/vec.h"
#include "scene/world/ground.h"

namespace skysweep::scene {

enum class BoxKind { building, roof_unit, car };

struct SolidBox {
  BoxKind kind = BoxKind::building;
  Vec2d center;
  Vec2d axis_u{1, 0};  // horizontal unit vector of side u; side v is turned left from it
  Vec2d half;          // half sides along u and v
  double z_low = 0, z_high = 0;
  std::uint32_t seed = 0;  // of its looks

  Vec2d axis_v() const { return {-axis_u.y, axis_u.x}; }
  Vec2d local(Vec2d p) const { return {dot(p - center, axis_u), dot(p - center, axis_v())}; }
  Vec2d from_local(Vec2d q) const { return center + q.x * axis_u + q.y * axis_v(); }
};

// East, turned clockwise.
inline Vec2d heading_axis(double heading_deg) {
  const double heading = heading_deg * std::numbers::pi / 180;
  return {std::cos(heading), -std::sin(heading)};
}

// Lowest ground under the corners and the middle of a box, less a foundation that closes any gap.
double foundation_z(const SolidBox& box, const Ground& ground);

}  // namespace skysweep::scene
