// SPDX-License-Identifier: Apache-2.0
// The inner geometry of a camera: a pinhole with Brown-Conrady lens distortion.
//
// Conventions, used everywhere in the program:
//   camera frame   x to the right of the photograph, y down, z along the view direction (as OpenCV and COLMAP)
//   normalised     (x / z, y / z), before or after distortion
//   pixels         the centre of the top-left pixel is (0.5, 0.5) (as COLMAP; OpenCV has (0, 0) there)
#pragma once

#include <optional>
#include <string>

#include "core/vec.h"

namespace skysweep::camera {

// Radial k1, k2, k3 and tangential p1, p2 (Brown 1971, in OpenCV's order of terms). All zero: no distortion.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  bool none() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
  friend bool operator==(const Distortion&, const Distortion&) = default;
};

struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0, fy_px = 0;  // focal length
  double cx_px = 0, cy_px = 0;  // principal point
  Distortion distortion;

  double focal_px() const { return 0.5 * (fx_px + fy_px); }
  // Nothing when the camera can be used, else a sentence that says what is wrong with it.
  std::optional<std::string> problem() const;
  friend bool operator==(const CameraModel&, const CameraModel&) = default;
};

// f_px = focal_mm * width_px / sensor_width_mm, principal point in the middle, square pixels.
CameraModel camera_from_sensor(double focal_mm, double sensor_width_mm, int width_px, int height_px);

// Normalised coordinates with lens distortion from those without.
inline Vec2d distort(const Distortion& d, Vec2d p) {
  const double r2 = dot(p, p);
  const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  return {p.x * radial + 2 * d.p1 * p.x * p.y + d.p2 * (r2 + 2 * p.x * p.x),
          p.y * radial + d.p1 * (r2 + 2 * p.y * p.y) + 2 * d.p2 * p.x * p.y};
}

// The inverse of `distort` by Newton's method; nothing if it does not converge to a point inside the fold radius.
std::optional<Vec2d> undistort(const Distortion& d, Vec2d distorted);
// The same for callers that keep the fold radius: finding it costs several times as much as the inversion itself.
std::optional<Vec2d> undistort(const Distortion& d, Vec2d distorted, double fold_radius_squared);

// Squared undistorted radius at which the radial polynomial stops growing: beyond it the lens model folds back and two
// directions share one pixel. Infinity when it never folds.
double fold_radius_squared(const Distortion& d);

}  // namespace skysweep::camera
