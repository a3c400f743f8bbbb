// SPDX-License-Identifier: Apache-2.0
#include "camera/pose.h"

#include <cmath>
#include <numbers>

namespace skysweep::camera {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// Sine and cosine of an angle in degrees, exact at multiples of 90 so that nadir is nadir.
struct SinCos {
  double sin, cos;
};
SinCos sin_cos_deg(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0) return {0, 1};
  if (turn == 90) return {1, 0};
  if (turn == -90) return {-1, 0};
  if (turn == 180 || turn == -180) return {0, -1};
  return {std::sin(turn * kRadians), std::cos(turn * kRadians)};
}

}  // namespace

std::optional<std::string> Pose::problem() const {
  if (!is_finite(center)) return "the position is not finite";
  for (const double v : cam_from_world.m)
    if (!std::isfinite(v)) return "the rotation is not finite";
  const Mat3d product = cam_from_world * transpose(cam_from_world);
  const Mat3d identity;
  for (int i = 0; i < 9; ++i)
    if (std::abs(product.m[i] - identity.m[i]) > 1e-6) return "the rotation matrix is not orthonormal";
  if (determinant(cam_from_world) < 0) return "the rotation matrix mirrors (its determinant is -1)";
  return std::nullopt;
}

Vec3d snap_position(Vec3d p) {
  const auto snap = [](double v) { return std::nearbyint(v * 0x1p20) * 0x1p-20; };
  return {snap(p.x), snap(p.y), snap(p.z)};
}

std::optional<Mat3d> rotation_from_quaternion(double w, double x, double y, double z) {
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  if (!(length > 0.9 && length < 1.1)) return std::nullopt;
  w /= length, x /= length, y /= length, z /= length;
  return Mat3d{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
                2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),  //
                2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

Mat3d rotation_from_yaw_pitch_roll(double yaw_deg, double pitch_deg, double roll_deg) {
  const auto [sy, cy] = sin_cos_deg(yaw_deg);
  const auto [sp, cp] = sin_cos_deg(pitch_deg);
  const auto [sr, cr] = sin_cos_deg(roll_deg);
  const Vec3d forward{sy * cp, cy * cp, sp};
  const Vec3d level_right{cy, -sy, 0};
  const Vec3d level_down{sy * sp, cy * sp, -cp};
  const Vec3d right = cr * level_right + sr * level_down;
  const Vec3d down = cr * level_down - sr * level_right;
  return {{right.x, right.y, right.z, down.x, down.y, down.z, forward.x, forward.y, forward.z}};
}

GimbalAngles yaw_pitch_roll_from_rotation(const Mat3d& cam_from_world) {
  const Vec3d right = cam_from_world.row(0), down = cam_from_world.row(1), view = cam_from_world.row(2);
  const double level = std::hypot(view.x, view.y);
  constexpr double kVertical = 1e-12;
  if (level < kVertical) {
    // Straight down the top of the photograph shows the yaw, straight up its bottom does.
    const double sign = view.z < 0 ? -1 : 1;
    return {std::atan2(sign * down.x, sign * down.y) / kRadians, view.z < 0 ? -90. : 90., 0};
  }
  // The horizon's right in the photograph; turned round if the photograph stands on its head.
  const Vec3d level_right{view.y / level, -view.x / level, 0};
  const double sign = dot(right, level_right) < 0 ? -1 : 1;
  const Vec3d level_down = sign * cross(view, level_right);
  return {std::atan2(sign * view.x, sign * view.y) / kRadians, std::atan2(view.z, sign * level) / kRadians,
          std::atan2(dot(right, level_down), sign * dot(right, level_right)) / kRadians};
}

Mat3d rotation_from_omega_phi_kappa(double omega_deg, double phi_deg, double kappa_deg) {
  const auto [so, co] = sin_cos_deg(omega_deg);
  const auto [sp, cp] = sin_cos_deg(phi_deg);
  const auto [sk, ck] = sin_cos_deg(kappa_deg);
  const Mat3d rx{{1, 0, 0, 0, co, -so, 0, so, co}};
  const Mat3d ry{{cp, 0, sp, 0, 1, 0, -sp, 0, cp}};
  const Mat3d rz{{ck, -sk, 0, sk, ck, 0, 0, 0, 1}};
  const Mat3d flip{{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  return flip * transpose(rx * ry * rz);
}

Quaternion quaternion_from_rotation(const Mat3d& r) {
  // Shepperd's method: divide by the largest of the four components.
  const double trace = r(0, 0) + r(1, 1) + r(2, 2);
  Quaternion q;
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    q = {s / 4, (r(2, 1) - r(1, 2)) / s, (r(0, 2) - r(2, 0)) / s, (r(1, 0) - r(0, 1)) / s};
  } else if (r(0, 0) > r(1, 1) && r(0, 0) > r(2, 2)) {
    const double s = 2 * std::sqrt(1 + r(0, 0) - r(1, 1) - r(2, 2));
    q = {(r(2, 1) - r(1, 2)) / s, s / 4, (r(0, 1) + r(1, 0)) / s, (r(0, 2) + r(2, 0)) / s};
  } else if (r(1, 1) > r(2, 2)) {
    const double s = 2 * std::sqrt(1 + r(1, 1) - r(0, 0) - r(2, 2));
    q = {(r(0, 2) - r(2, 0)) / s, (r(0, 1) + r(1, 0)) / s, s / 4, (r(1, 2) + r(2, 1)) / s};
  } else {
    const double s = 2 * std::sqrt(1 + r(2, 2) - r(0, 0) - r(1, 1));
    q = {(r(1, 0) - r(0, 1)) / s, (r(0, 2) + r(2, 0)) / s, (r(1, 2) + r(2, 1)) / s, s / 4};
  }
  return q.w < 0 ? Quaternion{-q.w, -q.x, -q.y, -q.z} : q;
}

}  // namespace skysweep::camera
