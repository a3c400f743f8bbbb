// SPDX-License-Identifier: Apache-2.0
#include "camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::camera {

namespace {
constexpr double kShortestFocal = 5e-4, kLongestFocal = 1e6;  // times the longer side of the image
constexpr double kFarthestPrincipalPoint = 1e7;               // pixels
}  // namespace

std::optional<std::string> CameraModel::problem() const {
  if (width_px <= 0 || height_px <= 0) return "the image size must be positive";
  if (!(std::isfinite(fx_px) && std::isfinite(fy_px) && fx_px > 0 && fy_px > 0))
    return "the focal length must be a positive number of pixels";
  // A view of 179.9 degrees, or one of a thousandth of a second of arc a pixel; beyond, quotients leave the doubles.
  const double longer_side = std::max(width_px, height_px);
  for (const double f : {fx_px, fy_px})
    if (f < kShortestFocal * longer_side || f > kLongestFocal * longer_side)
      return "the focal length must lie between " + std::to_string(kShortestFocal * longer_side) + " and " +
             std::to_string(kLongestFocal * longer_side) + " pixels for an image of this size";
  if (!(std::abs(cx_px) <= kFarthestPrincipalPoint && std::abs(cy_px) <= kFarthestPrincipalPoint))
    return "the principal point must be a finite number of pixels, not beyond 10^7";
  const Distortion& d = distortion;
  if (!(std::isfinite(d.k1) && std::isfinite(d.k2) && std::isfinite(d.k3) && std::isfinite(d.p1) &&
        std::isfinite(d.p2)))
    return "the distortion coefficients must be finite numbers";
  return std::nullopt;
}

CameraModel camera_from_sensor(double focal_mm, double sensor_width_mm, int width_px, int height_px) {
  const double focal_px = focal_mm * width_px / sensor_width_mm;
  return {width_px, height_px, focal_px, focal_px, 0.5 * width_px, 0.5 * height_px, {}};
}

std::optional<Vec2d> undistort(const Distortion& d, Vec2d distorted) {
  return undistort(d, distorted, fold_radius_squared(d));
}

std::optional<Vec2d> undistort(const Distortion& d, Vec2d distorted, double fold) {
  if (d.none()) return distorted;
  constexpr int kMaxIterations = 50;
  constexpr double kTolerance = 1e-13;
  Vec2d p = distorted;
  // Start inside the fold: from outside Newton's method would settle on the folded branch.
  if (const double r2 = dot(p, p); r2 >= fold) p = (0.9 * std::sqrt(fold / r2)) * p;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Vec2d error = distort(d, p) - distorted;
    const double r2 = dot(p, p);
    const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
    const double slope = 2 * (d.k1 + r2 * (2 * d.k2 + r2 * 3 * d.k3));  // d(radial) / d(r2) * 2
    const double jxx = radial + p.x * p.x * slope + 2 * d.p1 * p.y + 6 * d.p2 * p.x;
    const double jxy = p.x * p.y * slope + 2 * d.p1 * p.x + 2 * d.p2 * p.y;
    const double jyy = radial + p.y * p.y * slope + 6 * d.p1 * p.y + 2 * d.p2 * p.x;
    const double det = jxx * jyy - jxy * jxy;
    if (!(std::abs(det) > 1e-12)) return std::nullopt;
    Vec2d step{(jyy * error.x - jxy * error.y) / det, (jxx * error.y - jxy * error.x) / det};
    // Never step across the fold.
    double damping = 1;
    Vec2d next = p - step;
    while (dot(next, next) >= fold && damping > 1e-6) {
      damping *= 0.5;
      next = p - damping * step;
    }
    if (dot(next, next) >= fold) return std::nullopt;
    p = next;
    if (norm(step) < kTolerance * (1 + norm(p))) break;
  }
  if (!(norm(distort(d, p) - distorted) < 1e-10 * (1 + norm(distorted)))) return std::nullopt;
  return p;
}

double fold_radius_squared(const Distortion& d) {
  // Smallest positive root u = r^2 of d/dr [r (1 + k1 r^2 + k2 r^4 + k3 r^6)] = 1 + 3 k1 u + 5 k2 u^2 + 7 k3 u^3.
  const auto slope = [&](double u) { return 1 + u * (3 * d.k1 + u * (5 * d.k2 + u * 7 * d.k3)); };
  // Walk outwards in small relative steps to the first sign change, as far as a view of 178 degrees needs, then bisect.
  constexpr double kWidest = 3300;  // tan(89 degrees)^2
  double low = 0;
  for (double high = 1e-4; high < kWidest; high *= 1.02) {
    if (slope(high) <= 0) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (slope(middle) > 0 ? low : high) = middle;
      }
      return low;
    }
    low = high;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace skysweep::camera
