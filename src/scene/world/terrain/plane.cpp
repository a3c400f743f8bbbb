// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/world/terrain/direction.h"

namespace skysweep::scene {

TiltedPlane::TiltedPlane(const PlaneTerrain& shape)
    : slope_(std::tan(radians(shape.slope_deg)) * direction_of(shape.azimuth_deg)),
      z_of_origin_m_(-dot(slope_, shape.center)) {}

HeightSample TiltedPlane::at(Vec2d p) const { return {z_of_origin_m_ + dot(slope_, p), slope_}; }

HeightRange TiltedPlane::heights(const Box2d& box) const {
  HeightRange out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec2d corner : {box.min, box.max, Vec2d{box.min.x, box.max.y}, Vec2d{box.max.x, box.min.y}})
    out = {std::min(out.lowest, at(corner).z), std::max(out.highest, at(corner).z)};
  return out;
}

}  // namespace skysweep::scene
