// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "scene/world/terrain/direction.h"

namespace skysweep::scene {

Profile::Profile(std::vector<Corner> corners, double rounding_m)
    : corners_(std::move(corners)), rounding_m_(rounding_m) {
  SKY_CHECK_GE(corners_.size(), 2u);
  for (std::size_t i = 1; i < corners_.size(); ++i)
    SKY_CHECK_GE(corners_[i].u - corners_[i - 1].u, rounding_m_ * (1 - 1e-12));
}

double Profile::slope_after(int i) const {
  if (i < 0 || i + 1 >= static_cast<int>(corners_.size())) return 0;
  const Corner &a = corners_[static_cast<std::size_t>(i)], &b = corners_[static_cast<std::size_t>(i) + 1];
  return (b.z - a.z) / (b.u - a.u);
}

int Profile::corner_before(double u) const {
  const auto after = std::upper_bound(corners_.begin(), corners_.end(), u,
                                      [](double value, const Corner& corner) { return value < corner.u; });
  return static_cast<int>(after - corners_.begin()) - 1;
}

Profile::Sample Profile::at(double u) const {
  const int i = corner_before(u);
  Sample out;
  out.slope = slope_after(i);
  const Corner& from = corners_[static_cast<std::size_t>(std::max(0, i))];
  out.z = from.z + out.slope * (u - from.u);
  // Within half a rounding of a corner: the parabola that both pieces touch.
  for (const int near : {i, i + 1}) {
    if (near < 0 || near >= static_cast<int>(corners_.size())) continue;
    const Corner& corner = corners_[static_cast<std::size_t>(near)];
    const double inside = u - (corner.u - 0.5 * rounding_m_);
    if (inside <= 0 || inside >= rounding_m_) continue;
    const double before = slope_after(near - 1), bend = (slope_after(near) - before) / rounding_m_;
    out.slope = before + bend * inside;
    out.z = corner.z + before * (u - corner.u) + 0.5 * bend * inside * inside;
    break;
  }
  return out;
}

HeightRange Profile::heights(double u_low, double u_high) const {
  // The line stays within the hull of its corners; a rounding reaches as far as its neighbours' pieces do.
  const double reach = 0.5 * rounding_m_;
  const double first = at(u_low - reach).z, last = at(u_high + reach).z;
  HeightRange out{std::min(first, last), std::max(first, last)};
  for (const Corner& corner : corners_)
    if (corner.u >= u_low - reach && corner.u <= u_high + reach)
      out = {std::min(out.lowest, corner.z), std::max(out.highest, corner.z)};
  return out;
}

double Profile::curvature(double u_low, double u_high) const {
  if (rounding_m_ == 0) return 0;
  double out = 0;
  for (int i = 0; i < static_cast<int>(corners_.size()); ++i)
    if (std::abs(0.5 * (u_low + u_high) - corners_[static_cast<std::size_t>(i)].u) <
        0.5 * (u_high - u_low + rounding_m_) - 1e-9)
      out = std::max(out, std::abs(slope_after(i) - slope_after(i - 1)) / rounding_m_);
  return out;
}

double Profile::steepest(double u_low, double u_high) const {
  const double reach = 0.5 * rounding_m_;
  double out = 0;
  for (int i = corner_before(u_low - reach); i <= corner_before(u_high + reach); ++i)
    out = std::max(out, std::abs(slope_after(i)));
  return out;
}

std::vector<double> Profile::creases() const {
  std::vector<double> out;
  for (const Corner& corner : corners_) {
    if (rounding_m_ == 0) {
      out.push_back(corner.u);
      continue;
    }
    constexpr int kPieces = 8;  // so that a mesh follows the parabola
    for (int i = 0; i <= kPieces; ++i) out.push_back(corner.u + rounding_m_ * (1. * i / kPieces - 0.5));
  }
  return out;
}

ProfileSurface::ProfileSurface(Profile profile, double azimuth_deg, Vec2d center)
    : profile_(std::move(profile)), axis_u_(direction_of(azimuth_deg)), u_of_center_(dot(center, axis_u_)) {}

HeightSample ProfileSurface::at(Vec2d p) const {
  const Profile::Sample here = profile_.at(dot(p, axis_u_) - u_of_center_);
  return {here.z, here.slope * axis_u_};
}

HeightRange ProfileSurface::heights(const Box2d& box) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2d corner : {box.min, box.max, Vec2d{box.min.x, box.max.y}, Vec2d{box.max.x, box.min.y}}) {
    low = std::min(low, dot(corner, axis_u_) - u_of_center_);
    high = std::max(high, dot(corner, axis_u_) - u_of_center_);
  }
  return profile_.heights(low, high);
}

MeshPlan ProfileSurface::mesh_plan() const {
  MeshPlan plan;
  plan.axis_u = axis_u_;
  // Beside a rounding the cells must not be long, for what a mesh deviates grows with their diagonal.
  if (profile_.rounding_m() > 0) plan.spacing_m = 0.5 * profile_.rounding_m();
  for (const double u : profile_.creases()) plan.u_creases.push_back(u + u_of_center_);
  return plan;
}

double ProfileSurface::curvature(const Box2d& box) const {
  return profile_.curvature(box.min.x - u_of_center_, box.max.x - u_of_center_);
}

}  // namespace skysweep::scene
