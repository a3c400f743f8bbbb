// SPDX-License-Identifier: Apache-2.0
#include "render/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/error.h"

namespace skysweep::render {
namespace {

constexpr double kMargin = 1.04;  // a named view's surroundings of the surface
constexpr double kRadians = std::numbers::pi / 180;

double half_width(double fov_deg) { return std::tan(fov_deg / 2 * kRadians); }

// From right, down and view direction as rows.
camera::Pose pose_of(Vec3d center, Vec3d right, Vec3d forward) {
  const Vec3d down = cross(forward, right);
  return {{{right.x, right.y, right.z, down.x, down.y, down.z, forward.x, forward.y, forward.z}}, center};
}

// Azimuth that is looked towards, clockwise from north, and angle below the horizon, degrees.
struct Direction {
  double azimuth_deg, below_horizon_deg;
};
constexpr std::array<Direction, 4> kDirections = {{{25, 40}, {0, 20}, {0, 90}, {315, 45}}};

// A level horizon needs no special case for the plumb view here: right is known from the azimuth.
camera::Pose pose_towards(Vec3d center, Direction d) {
  const double azimuth = d.azimuth_deg * kRadians, below = d.below_horizon_deg * kRadians;
  const Vec3d right{std::cos(azimuth), -std::sin(azimuth), 0};
  const Vec3d forward{std::sin(azimuth) * std::cos(below), std::cos(azimuth) * std::cos(below), -std::sin(below)};
  return pose_of(center, right, forward);
}

std::array<Vec3d, 8> corners(const Box3d& box) {
  std::array<Vec3d, 8> all;
  for (int i = 0; i < 8; ++i)
    all[static_cast<std::size_t>(i)] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                        i & 4 ? box.max.z : box.min.z};
  return all;
}

// How far behind the pose's centre everything fits, the view direction kept.
double fitting_distance(const camera::Pose& pose, const Box3d& bounds, double tan_x, double tan_y) {
  double distance = 0;
  for (const Vec3d corner : corners(bounds)) {
    const Vec3d p = pose.cam_from_world * (corner - pose.center);
    distance = std::max({distance, std::abs(p.x) / tan_x - p.z, std::abs(p.y) / tan_y - p.z});
  }
  return distance;
}

// The pose's centre moved sideways until the bounds lie in the middle of what is seen from `distance` behind it.
void center_bounds(camera::Pose& pose, const Box3d& bounds, double distance) {
  Box2d seen;
  for (const Vec3d corner : corners(bounds)) {
    const Vec3d p = pose.cam_from_world * (corner - pose.center);
    seen.extend({p.x / (p.z + distance), p.y / (p.z + distance)});
  }
  pose.center = pose.center + 0.5 * distance * (seen.min.x + seen.max.x) * pose.right() +
                0.5 * distance * (seen.min.y + seen.max.y) * pose.down();
}

View framed_perspective(camera::Pose pose, const Box3d& bounds, double fov_deg, PictureSize size) {
  constexpr int kRounds = 8;  // each leaves a fraction of the way to go
  const double tan_x = half_width(fov_deg) / kMargin, tan_y = tan_x * size.height_px / size.width_px;
  for (int i = 0; i < kRounds; ++i) center_bounds(pose, bounds, fitting_distance(pose, bounds, tan_x, tan_y));
  const double distance = fitting_distance(pose, bounds, tan_x, tan_y);
  pose.center = camera::snap_position(pose.center - distance * pose.view_direction());
  return perspective_view(pose, fov_deg, size);
}

View framed_parallel(const camera::Pose& pose, const Box3d& bounds, PictureSize size) {
  double pixel_m = 0, nearest = 0;
  for (const Vec3d corner : corners(bounds)) {
    const Vec3d p = pose.cam_from_world * (corner - pose.center);
    pixel_m = std::max({pixel_m, 2 * std::abs(p.x) / size.width_px, 2 * std::abs(p.y) / size.height_px});
    nearest = std::min(nearest, p.z);
  }
  // Rays start before the highest spike, which the bounds may leave out.
  const double back = 2 * std::abs(nearest) + 1000;
  return {{pose.cam_from_world, pose.center - back * pose.view_direction()}, kMargin * pixel_m, size};
}

}  // namespace

View::View(const camera::Camera& camera)
    : pose_(camera.pose()),
      size_{camera.model().width_px, camera.model().height_px},
      pixel_{0, 1 / camera.model().focal_px()},
      camera_(camera) {}

View::View(const camera::Pose& pose, double pixel_m, PictureSize size) : pose_(pose), size_(size), pixel_{pixel_m, 0} {}

std::optional<Ray> View::ray(Vec2d pixel) const {
  if (camera_) {
    const std::optional<Vec3d> direction = camera_->ray(pixel);
    if (!direction) return std::nullopt;
    return Ray{pose_.center, *direction};
  }
  const double right = (pixel.x - size_.width_px / 2.) * pixel_.fixed_m;
  const double down = (pixel.y - size_.height_px / 2.) * pixel_.fixed_m;
  return Ray{pose_.center + right * pose_.right() + down * pose_.down(), pose_.view_direction()};
}

camera::Pose look_at(Vec3d eye, Vec3d target) {
  const Vec3d forward = normalized(target - eye);
  const Vec3d level = cross(forward, {0, 0, 1});
  const Vec3d right = norm(level) > 1e-9 ? normalized(level) : Vec3d{1, 0, 0};
  return pose_of(eye, right, forward);
}

View perspective_view(const camera::Pose& pose, double fov_deg, PictureSize size) {
  SKY_CHECK(fov_deg > 0 && fov_deg < 180);
  camera::CameraModel model;
  model.width_px = size.width_px, model.height_px = size.height_px;
  model.fx_px = model.fy_px = size.width_px / 2. / half_width(fov_deg);
  model.cx_px = size.width_px / 2., model.cy_px = size.height_px / 2.;
  return View(camera::Camera(model, pose));
}

View parallel_view(Vec3d eye, Vec3d target, double fov_deg, PictureSize size) {
  return {look_at(eye, target), 2 * half_width(fov_deg) * norm(target - eye) / size.width_px, size};
}

const std::vector<std::string>& named_view_names() {
  static const std::vector<std::string> names = {"overview", "north", "top", "oblique"};
  return names;
}

bool is_parallel(NamedView view) { return view == NamedView::top || view == NamedView::oblique; }

View named_view(NamedView view, const Box3d& bounds, double fov_deg, bool parallel, PictureSize size) {
  SKY_CHECK(!bounds.empty());
  const camera::Pose pose = pose_towards(0.5 * (bounds.min + bounds.max), kDirections[static_cast<std::size_t>(view)]);
  return parallel || is_parallel(view) ? framed_parallel(pose, bounds, size)
                                       : framed_perspective(pose, bounds, fov_deg, size);
}

View photograph_view(const camera::Camera& camera, PictureSize size) {
  camera::CameraModel model = camera.model();
  const double scale = 1. * size.width_px / model.width_px;
  if (std::abs(scale * model.height_px - size.height_px) > 1)
    throw usage_error("--size must keep the shape of the photograph, " + std::to_string(model.width_px) + "x" +
                      std::to_string(model.height_px) + ": " + std::to_string(size.width_px) + "x" +
                      std::to_string(std::lround(scale * model.height_px)) + " would.");
  const double scale_y = 1. * size.height_px / model.height_px;
  model.width_px = size.width_px, model.height_px = size.height_px;
  model.fx_px *= scale, model.cx_px *= scale;
  model.fy_px *= scale_y, model.cy_px *= scale_y;
  return View(camera::Camera(model, camera.pose()));
}

}  // namespace skysweep::render
