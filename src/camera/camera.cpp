// SPDX-License-Identifier: Apache-2.0
#include "camera/camera.h"

#include "core/check.h"

namespace skysweep::camera {

Camera::Camera(const CameraModel& model, const Pose& pose)
    : model_(model), pose_(pose), fold_radius_squared_(camera::fold_radius_squared(model.distortion)) {
  SKY_CHECK(!model.problem());
  SKY_CHECK(!pose.problem());
}

std::optional<Vec3d> Camera::ray(Vec2d pixel) const {
  const Vec2d distorted{(pixel.x - model_.cx_px) / model_.fx_px, (pixel.y - model_.cy_px) / model_.fy_px};
  const std::optional<Vec2d> n = undistort(model_.distortion, distorted, fold_radius_squared_);
  if (!n) return std::nullopt;
  return normalized(transpose(pose_.cam_from_world) * Vec3d{n->x, n->y, 1});
}

std::optional<Vec3d> Camera::at_height(Vec2d pixel, double z) const {
  const std::optional<Vec3d> direction = ray(pixel);
  if (!direction || direction->z == 0) return std::nullopt;
  const double distance = (z - pose_.center.z) / direction->z;
  if (!(distance > 0)) return std::nullopt;
  const Vec3d point = pose_.center + distance * *direction;
  return Vec3d{point.x, point.y, z};
}

Camera Camera::relative_to(Vec3d origin) const {
  return {model_, {pose_.cam_from_world, snap_position(pose_.center - origin)}};
}

}  // namespace skysweep::camera
