// SPDX-License-Identifier: Apache-2.0
// What a photograph shows of the ground: class of view, footprint polygon, box of the view pyramid.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/camera.h"

namespace skysweep::camera {
namespace {

constexpr double kVerticalLimitDeg = 3;
constexpr int kPointsPerSide = 8;  // a distorted border is a curve

// Pixels around the border of the photograph.
std::vector<Vec2d> border_pixels(const CameraModel& model) {
  const double w = model.width_px, h = model.height_px;
  std::vector<Vec2d> pixels;
  for (int i = 0; i < kPointsPerSide; ++i) {
    const double s = static_cast<double>(i) / kPointsPerSide;
    pixels.push_back({s * w, 0});
    pixels.push_back({w, s * h});
    pixels.push_back({(1 - s) * w, h});
    pixels.push_back({0, (1 - s) * h});
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

// Ground points of the border rays at height z, cut off at max_distance_m from the CoP.
void add_ground_points(const Camera& camera, double z, double max_distance_m, std::vector<Vec2d>& points) {
  const Vec3d center = camera.pose().center;
  if (center.z <= z) return;
  for (const Vec2d pixel : border_pixels(camera.model())) {
    const std::optional<Vec3d> direction = camera.ray(pixel);
    if (!direction) continue;
    double distance = max_distance_m;
    if (direction->z < 0) distance = std::min(distance, (z - center.z) / direction->z);
    const Vec3d point = center + distance * *direction;
    points.push_back({point.x, point.y});
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
