// SPDX-License-Identifier: Apache-2.0
// Where a camera stood and how it was turned. World frame: x east, y north, z up, metres.
#pragma once

#include <optional>
#include <string>

#include "core/vec.h"

namespace skysweep::camera {

struct Pose {
  Mat3d cam_from_world;  // rotation; its rows are the camera's right, down and view direction in world coordinates
  Vec3d center;          // centre of projection (CoP) in the world, metres

  Vec3d right() const { return cam_from_world.row(0); }
  Vec3d down() const { return cam_from_world.row(1); }
  Vec3d view_direction() const { return cam_from_world.row(2); }
  // Nothing when the pose can be used, else a sentence: not finite, or not a rotation.
  std::optional<std::string> problem() const;
  friend bool operator==(const Pose&, const Pose&) = default;
};

// Positions are snapped to multiples of 2^-20 m (about one micrometre) when they are read, so that differences between
// positions of UTM size are exact in double precision and moving a scene changes no bit of its result.
Vec3d snap_position(Vec3d p);

// World-to-camera rotation from a quaternion as COLMAP stores it. It is normalised; nothing if its length is not
// within 10 % of one or not finite.
std::optional<Mat3d> rotation_from_quaternion(double qw, double qx, double qy, double qz);

// World-to-camera rotation from the angles a gimbal reports, in degrees: yaw clockwise from north, pitch above the
// horizon (-90 looks straight down, with the top of the photograph towards the yaw direction), roll clockwise about
// the view direction.
Mat3d rotation_from_yaw_pitch_roll(double yaw_deg, double pitch_deg, double roll_deg);

struct GimbalAngles {
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};
// The same angles from a rotation: yaw from -180 to 180, roll from -90 to 90, pitch whatever it then is (below -90 for
// a camera that looks down and back). Exactly at the vertical, where only one of yaw and roll is fixed, roll is 0.
GimbalAngles yaw_pitch_roll_from_rotation(const Mat3d& cam_from_world);

// World-to-camera rotation from the angles of aerial photogrammetry, in degrees: the rotation from the image frame
// (x right, y up, z backwards) to the world is Rx(omega) Ry(phi) Rz(kappa); all zero looks down, top to the north.
Mat3d rotation_from_omega_phi_kappa(double omega_deg, double phi_deg, double kappa_deg);

struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};
// Unit quaternion of a rotation, with w >= 0.
Quaternion quaternion_from_rotation(const Mat3d& r);

}  // namespace skysweep::camera
