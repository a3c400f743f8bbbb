// SPDX-License-Identifier: Apache-2.0
// A camera in the world: projects points into its photograph and pixels out of it. Double precision throughout;
// immutable, so safe to share between threads.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera_model.h"
#include "camera/pose.h"
#include "core/box.h"
#include "core/vec.h"

namespace skysweep::camera {

class Camera {
 public:
  // Both must be usable: model.problem() and pose.problem() say nothing.
  Camera(const CameraModel& model, const Pose& pose);

  const CameraModel& model() const { return model_; }
  const Pose& pose() const { return pose_; }

  // Pixel at which the world point appears; nothing for points behind the camera or beyond the fold of the lens model.
  // The pixel may lie outside the photograph: see `shows`.
  std::optional<Vec2d> project(Vec3d world) const {
    const Vec3d p = pose_.cam_from_world * (world - pose_.center);
    if (!(p.z > 0)) return std::nullopt;
    const Vec2d n{p.x / p.z, p.y / p.z};
    if (!(dot(n, n) < fold_radius_squared_)) return std::nullopt;
    const Vec2d d = distort(model_.distortion, n);
    return Vec2d{model_.fx_px * d.x + model_.cx_px, model_.fy_px * d.y + model_.cy_px};
  }

  // Whether a pixel position lies on the photograph, [0, width] x [0, height].
  bool shows(Vec2d pixel) const {
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= model_.width_px && pixel.y <= model_.height_px;
  }

  // Unit vector in the world along which the pixel looks; nothing where the lens model cannot be inverted.
  std::optional<Vec3d> ray(Vec2d pixel) const;

  // Where the ray of the pixel meets the horizontal plane at z (a pixel fixes x, y only once z is known);
  // nothing if it never does in front of the camera.
  std::optional<Vec3d> at_height(Vec2d pixel, double z) const;

  // Distance of a world point from the camera along its view direction, metres.
  double depth(Vec3d world) const { return dot(pose_.view_direction(), world - pose_.center); }

  // Ground sampling distance at a depth: metres of object per pixel, across the view direction.
  double gsd(double depth_m) const { return depth_m / model_.focal_px(); }

  // The same camera in a frame whose origin is at `origin`; the new position is snapped (see snap_position).
  Camera relative_to(Vec3d origin) const;

 private:
  CameraModel model_;
  Pose pose_;
  double fold_radius_squared_;
};

enum class ViewClass {
  vertical,       // below 3 degrees from nadir
  near_vertical,  // still serves matching
  oblique,        // textures lateral surfaces only
  high_oblique,   // shows the horizon
};

// `matching_limit_deg`: the largest angle from nadir at which a photograph is still matched.
ViewClass classify(const Camera& camera, double matching_limit_deg);
const char* to_string(ViewClass view_class);

// Angle between view direction and nadir, degrees.
double off_nadir_deg(const Pose& pose);

// Outline on the ground, counter-clockwise and convex: what the photograph shows of any surface between the heights
// z_low and z_high. It ends at `max_distance_m` from the CoP, so that a view of the horizon has an outline too.
// Empty if the camera is below z_low or sees nothing of it within the distance.
std::vector<Vec2d> footprint(const Camera& camera, double z_low, double z_high, double max_distance_m);

// Axis-aligned box of the view pyramid: from the CoP to the footprint at z_low. Key of the R*-tree.
Box3d view_pyramid_box(const Camera& camera, double z_low, double max_distance_m);

}  // namespace skysweep::camera
