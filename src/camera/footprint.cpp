// SPDX-License-Identifier: Apache-2.0
// What a photograph shows of the ground: class of view, footprint polygon, box of the view pyramid.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "camera/camera.h"

namespace skysweep::camera {
namespace {

constexpr double kVerticalLimitDeg = 3;
constexpr int kPointsPerSide = 8;  // a distorted border is a curve
constexpr int kRingPoints = 64;    // a ring of 64 points misses its circle by 0.1 % of the radius

// Pixels around the border of the photograph, in order.
std::vector<Vec2d> border_pixels(const CameraModel& model) {
  const double w = model.width_px, h = model.height_px;
  const Vec2d corners[] = {{0, 0}, {w, 0}, {w, h}, {0, h}, {0, 0}};
  std::vector<Vec2d> pixels;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kPointsPerSide; ++i) {
      const double s = static_cast<double>(i) / kPointsPerSide;
      pixels.push_back(corners[side] + s * (corners[side + 1] - corners[side]));
    }
  return pixels;
}

// Andrew's monotone chain; counter-clockwise, without repeated or collinear points.
std::vector<Vec2d> convex_hull(std::vector<Vec2d> points) {
  std::sort(points.begin(), points.end(), [](Vec2d a, Vec2d b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  std::vector<Vec2d> hull;
  const auto add_chain = [&hull](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // first point of the next chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull.size() < 3 ? std::vector<Vec2d>{} : hull;
}

// Where the pixel's ray meets the ground at height z, unless that is beyond `max_distance_m` (or never).
std::optional<Vec2d> ground_point(const Camera& camera, Vec2d pixel, double z, double max_distance_m) {
  const std::optional<Vec3d> point = camera.at_height(pixel, z);
  if (!point || norm(*point - camera.pose().center) > max_distance_m) return std::nullopt;
  return Vec2d{point->x, point->y};
}

// Ground point of the last pixel on the way from `inner`, which has one, to `outer`, which has none.
Vec2d last_ground_point(const Camera& camera, Vec2d inner, Vec2d outer, double z, double max_distance_m) {
  Vec2d last = *ground_point(camera, inner, z, max_distance_m);
  for (int i = 0; i < 40; ++i) {
    const Vec2d middle = 0.5 * (inner + outer);
    const std::optional<Vec2d> point = ground_point(camera, middle, z, max_distance_m);
    if (point) last = *point;
    (point ? inner : outer) = middle;
  }
  return last;
}

// Outline of what the photograph shows of the ground at height z: the border of the photograph on the ground and, where
// the view reaches farther, the circle at which the distance ends it.
void add_ground_points(const Camera& camera, double z, double max_distance_m, std::vector<Vec2d>& points) {
  const Vec3d center = camera.pose().center;
  const double height = center.z - z;
  if (height <= 0 || height > max_distance_m) return;
  const std::vector<Vec2d> border = border_pixels(camera.model());
  bool is_cut_off = false;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Vec2d here = border[i], next = border[(i + 1) % border.size()];
    const auto ground_here = ground_point(camera, here, z, max_distance_m);
    const auto ground_next = ground_point(camera, next, z, max_distance_m);
    if (ground_here) points.push_back(*ground_here);
    if (ground_here && !ground_next) points.push_back(last_ground_point(camera, here, next, z, max_distance_m));
    if (!ground_here && ground_next) points.push_back(last_ground_point(camera, next, here, z, max_distance_m));
    is_cut_off |= !ground_here;
  }
  if (!is_cut_off) return;
  const double radius = std::sqrt(max_distance_m * max_distance_m - height * height);
  for (int i = 0; i < kRingPoints; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / kRingPoints;
    const Vec3d point{center.x + radius * std::sin(azimuth), center.y + radius * std::cos(azimuth), z};
    if (const auto pixel = camera.project(point); pixel && camera.shows(*pixel)) points.push_back({point.x, point.y});
  }
}

bool shows_horizon(const Camera& camera) {
  for (const Vec2d pixel : border_pixels(camera.model()))
    if (const auto direction = camera.ray(pixel); direction && direction->z >= 0) return true;
  return false;
}

}  // namespace

double off_nadir_deg(const Pose& pose) {
  return std::acos(std::clamp(-pose.view_direction().z, -1.0, 1.0)) * 180 / std::numbers::pi;
}

ViewClass classify(const Camera& camera, double matching_limit_deg) {
  if (shows_horizon(camera)) return ViewClass::high_oblique;
  const double angle = off_nadir_deg(camera.pose());
  if (angle < kVerticalLimitDeg) return ViewClass::vertical;
  return angle <= matching_limit_deg ? ViewClass::near_vertical : ViewClass::oblique;
}

const char* to_string(ViewClass view_class) {
  switch (view_class) {
    case ViewClass::vertical: return "vertical";
    case ViewClass::near_vertical: return "near-vertical";
    case ViewClass::oblique: return "oblique";
    case ViewClass::high_oblique: return "high oblique";
  }
  return "unknown";
}

std::vector<Vec2d> footprint(const Camera& camera, double z_low, double z_high, double max_distance_m) {
  std::vector<Vec2d> points;
  add_ground_points(camera, z_low, max_distance_m, points);
  if (z_high > z_low) add_ground_points(camera, z_high, max_distance_m, points);
  return convex_hull(std::move(points));
}

Box3d view_pyramid_box(const Camera& camera, double z_low, double max_distance_m) {
  Box3d box;
  box.extend(camera.pose().center);
  std::vector<Vec2d> points;
  add_ground_points(camera, z_low, max_distance_m, points);
  for (const Vec2d p : points) box.extend({p.x, p.y, z_low});
  return box;
}

}  // namespace skysweep::camera
