// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/quarry.h"

#include <algorithm>
#include <cmath>

#include "scene/world/terrain/direction.h"

namespace skysweep::scene {
namespace {

Profile benches(const QuarryTerrain& shape) {
  const double face_m = shape.height_m / std::tan(radians(shape.face_deg));
  std::vector<Profile::Corner> corners;
  double inward = 0, z = 0;
  for (int i = 0; i < shape.steps; ++i) {
    corners.push_back({inward, z});
    inward += face_m;
    z -= shape.height_m;
    corners.push_back({inward, z});
    inward += shape.bench_m;
  }
  return {corners, shape.break_width_m};
}

}  // namespace

Quarry::Quarry(const QuarryTerrain& shape)
    : shape_(shape), profile_(benches(shape)), axis_u_(direction_of(shape.heading_deg + 90)) {}

Vec2d Quarry::to_uv(Vec2d p) const {
  const Vec2d d = p - shape_.center;
  return {dot(d, axis_u_), cross(axis_u_, d)};
}

Quarry::Distance Quarry::distance(Vec2d uv) const {
  const double radius = shape_.corner_radius_m();
  const Vec2d sign{uv.x < 0 ? -1. : 1., uv.y < 0 ? -1. : 1.};
  // From the rectangle of the corners' centres.
  const Vec2d out{std::abs(uv.x) - (0.5 * shape_.size_m.x - radius), std::abs(uv.y) - (0.5 * shape_.size_m.y - radius)};
  if (out.x > 0 && out.y > 0) {
    const double far = norm(out);
    return {radius - far, {-sign.x * out.x / far, -sign.y * out.y / far}};
  }
  if (out.x > out.y) return {radius - out.x, {-sign.x, 0}};
  return {radius - out.y, {0, -sign.y}};
}

HeightSample Quarry::at(Vec2d p) const {
  const Distance rim = distance(to_uv(p));
  const Profile::Sample here = profile_.at(rim.inward);
  const Vec2d axis_v{-axis_u_.y, axis_u_.x};
  return {here.z, here.slope * (rim.gradient.x * axis_u_ + rim.gradient.y * axis_v)};
}

HeightRange Quarry::heights(const Box2d&) const { return {-shape_.deepest_m(), 0}; }

MeshPlan Quarry::mesh_plan() const {
  constexpr double kPerRounding = 2;
  MeshPlan plan;
  plan.axis_u = axis_u_;
  plan.spacing_m = shape_.break_width_m / kPerRounding;
  return plan;
}

double Quarry::curvature(const Box2d& box) const {
  // The distance from the rim changes by no more than the way that is gone. Where it is less than the corner radius,
  // its level lines have at least the radius at the foot of the lowest face; further in the floor is level.
  const Vec2d axis_v{-axis_u_.y, axis_u_.x};
  const Vec2d center = 0.5 * (box.min + box.max);
  const double reach = 0.5 * norm(box.max - box.min);
  const double inward = distance(to_uv(center.x * axis_u_ + center.y * axis_v)).inward;
  const double sharpest_m = shape_.corner_radius_m() - shape_.margin_m() - 0.5 * shape_.break_width_m;
  return profile_.curvature(inward - reach, inward + reach) +
         profile_.steepest(inward - reach, inward + reach) / sharpest_m;
}

}  // namespace skysweep::scene
