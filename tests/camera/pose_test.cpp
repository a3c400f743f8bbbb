// SPDX-License-Identifier: Apache-2.0
// The conventions of pose angles, each checked against what a person would work out by hand.
#include "camera/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "camera/camera.h"
#include "core/random.h"

namespace skysweep::camera {
namespace {

constexpr Vec3d kEast{1, 0, 0}, kNorth{0, 1, 0}, kUp{0, 0, 1};
constexpr Vec3d kWest{-1, 0, 0}, kSouth{0, -1, 0}, kDown{0, 0, -1};

void expect_near(Vec3d actual, Vec3d expected, double tolerance = 1e-15) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.z, expected.z, tolerance);
}

// Axes of the camera: right side, top and view direction of the photograph in the world.
void expect_axes(const Mat3d& rotation, Vec3d right, Vec3d top, Vec3d view) {
  const Pose pose{rotation, {}};
  EXPECT_FALSE(pose.problem());
  expect_near(pose.right(), right);
  expect_near(-pose.down(), top);
  expect_near(pose.view_direction(), view);
}

double largest_difference(const Mat3d& a, const Mat3d& b) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.m[i] - b.m[i]));
  return largest;
}

TEST(YawPitchRoll, nadir_points_the_top_of_the_photograph_along_the_yaw) {
  expect_axes(rotation_from_yaw_pitch_roll(0, -90, 0), kEast, kNorth, kDown);
  expect_axes(rotation_from_yaw_pitch_roll(90, -90, 0), kSouth, kEast, kDown);
  expect_axes(rotation_from_yaw_pitch_roll(180, -90, 0), kWest, kSouth, kDown);
  expect_axes(rotation_from_yaw_pitch_roll(-90, -90, 0), kNorth, kWest, kDown);
}

TEST(YawPitchRoll, level_looks_along_the_yaw_with_the_sky_on_top) {
  expect_axes(rotation_from_yaw_pitch_roll(0, 0, 0), kEast, kUp, kNorth);
  expect_axes(rotation_from_yaw_pitch_roll(90, 0, 0), kSouth, kUp, kEast);
}

TEST(YawPitchRoll, positive_roll_dips_the_right_side) {
  expect_axes(rotation_from_yaw_pitch_roll(0, 0, 90), kDown, kEast, kNorth);
}

TEST(YawPitchRoll, zenith_is_no_singularity) {
  expect_axes(rotation_from_yaw_pitch_roll(0, 90, 0), kEast, kSouth, kUp);
}

TEST(YawPitchRoll, in_gimbal_lock_yaw_and_roll_add_up) {
  // Looking down, a turn about the view direction (clockwise in the photograph's own view) is a turn of the yaw.
  for (const double a : {10.0, 45.0, 133.0})
    EXPECT_LT(
        largest_difference(rotation_from_yaw_pitch_roll(20, -90, a), rotation_from_yaw_pitch_roll(20 + a, -90, 0)),
        1e-15);
}

TEST(YawPitchRoll, quarter_turns_are_exact_whatever_the_number_of_whole_turns) {
  EXPECT_EQ(rotation_from_yaw_pitch_roll(0, -90, 0), rotation_from_yaw_pitch_roll(-720, 270, 360));
  EXPECT_EQ(rotation_from_yaw_pitch_roll(90, -90, 0), rotation_from_yaw_pitch_roll(-270, -90, 0));
}

TEST(OmegaPhiKappa, all_zero_looks_down_with_north_on_top) {
  EXPECT_EQ(rotation_from_omega_phi_kappa(0, 0, 0), rotation_from_yaw_pitch_roll(0, -90, 0));
}

TEST(OmegaPhiKappa, each_angle_turns_counter_clockwise_about_its_axis) {
  expect_axes(rotation_from_omega_phi_kappa(0, 0, 90), kNorth, kWest, kDown);
  expect_axes(rotation_from_omega_phi_kappa(90, 0, 0), kEast, kUp, kNorth);
  expect_axes(rotation_from_omega_phi_kappa(0, 90, 0), kDown, kNorth, kWest);
}

TEST(OmegaPhiKappa, turns_about_the_moved_axes_in_the_order_omega_phi_kappa) {
  // Omega lifts the view to the north; phi then turns about the photograph's own up axis, which now points upwards.
  expect_axes(rotation_from_omega_phi_kappa(90, 90, 0), kNorth, kUp, kWest);
}

TEST(Quaternion, gives_the_rotation_of_its_axis_and_angle) {
  const double half = std::sqrt(0.5);
  EXPECT_EQ(rotation_from_quaternion(1, 0, 0, 0), Mat3d{});
  // 90 degrees about z takes x to y.
  expect_near(*rotation_from_quaternion(half, 0, 0, half) * kEast, kNorth);
  // 180 degrees about x: the nadir camera with north on top.
  EXPECT_EQ(*rotation_from_quaternion(0, 1, 0, 0), rotation_from_yaw_pitch_roll(0, -90, 0));
}

TEST(Quaternion, round_trip_at_every_kind_of_rotation) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Mat3d r =
        rotation_from_yaw_pitch_roll(random.uniform(-180, 180), random.uniform(-90, 90), random.uniform(-180, 180));
    const Quaternion q = quaternion_from_rotation(r);
    EXPECT_GE(q.w, 0);
    EXPECT_LT(largest_difference(*rotation_from_quaternion(q.w, q.x, q.y, q.z), r), 1e-14);
  }
  for (const Mat3d& half_turn : {Mat3d{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, Mat3d{{-1, 0, 0, 0, 1, 0, 0, 0, -1}},
                                 Mat3d{{-1, 0, 0, 0, -1, 0, 0, 0, 1}}}) {
    const Quaternion q = quaternion_from_rotation(half_turn);
    EXPECT_EQ(*rotation_from_quaternion(q.w, q.x, q.y, q.z), half_turn);
  }
}

TEST(Quaternion, is_normalised_when_a_little_off_and_refused_when_far_off) {
  EXPECT_LT(largest_difference(*rotation_from_quaternion(0, 1.05, 0, 0), *rotation_from_quaternion(0, 1, 0, 0)), 1e-15);
  EXPECT_FALSE(rotation_from_quaternion(0, 0, 0, 0));
  EXPECT_FALSE(rotation_from_quaternion(1, 1, 0, 0));
  EXPECT_FALSE(rotation_from_quaternion(std::numeric_limits<double>::quiet_NaN(), 0, 0, 0));
}

TEST(Pose, says_what_is_wrong_with_it) {
  EXPECT_FALSE(Pose{}.problem());
  EXPECT_TRUE((Pose{{}, {0, std::numeric_limits<double>::infinity(), 0}}.problem()));
  EXPECT_TRUE((Pose{{{1, 0, 0, 0, 1, 0, 0, 0, -1}}, {}}.problem()));     // mirrors
  EXPECT_TRUE((Pose{{{1.001, 0, 0, 0, 1, 0, 0, 0, 1}}, {}}.problem()));  // stretches
  EXPECT_TRUE((Pose{{{1, 0.01, 0, 0, 1, 0, 0, 0, 1}}, {}}.problem()));   // shears
  EXPECT_TRUE((Pose{{{std::nan(""), 0, 0, 0, 1, 0, 0, 0, 1}}, {}}.problem()));
}

TEST(SnapPosition, is_idempotent_and_moves_by_less_than_a_micrometre) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p{random.uniform(2e5, 8e5), random.uniform(-1e7, 1e7), random.uniform(-100, 9000)};
    const Vec3d snapped = snap_position(p);
    EXPECT_EQ(snap_position(snapped), snapped);
    EXPECT_LE(std::abs(snapped.x - p.x), 0x1p-21);
    EXPECT_LE(std::abs(snapped.y - p.y), 0x1p-21);
    EXPECT_LE(std::abs(snapped.z - p.z), 0x1p-21);
  }
}

TEST(SnapPosition, makes_camera_positions_independent_of_where_the_scene_lies) {
  Random random(6);
  const CameraModel model{4000, 3000, 3000, 3000, 2000, 1500, {}};
  const Mat3d rotation = rotation_from_yaw_pitch_roll(33, -80, 2);
  for (int i = 0; i < 200; ++i) {
    const Vec3d local = snap_position({random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(50, 150)});
    const Vec3d origin{std::floor(random.uniform(-100, 100)), std::floor(random.uniform(-100, 100)), 0};
    const Camera here = Camera(model, {rotation, local}).relative_to(origin);
    for (const Vec3d move : {Vec3d{412'345, 5'654'321, 0}, Vec3d{-10'000'000, 10'000'000, 4000}}) {
      const Camera there = Camera(model, {rotation, snap_position(local + move)}).relative_to(origin + move);
      EXPECT_EQ(there.pose(), here.pose());
    }
  }
}

TEST(SnapPosition, hides_the_rounding_of_tile_origins_that_are_not_exact_in_binary) {
  // 51.2 m has no exact double, so k * 51.2 and the differences of such numbers round, differently at each k.
  const CameraModel model{4000, 3000, 3000, 3000, 2000, 1500, {}};
  const Vec3d offset{12.25, 40.5, 80};
  for (const double k : {1.0, 1001.0, 8053.0, 110'437.0, -99'999.0}) {
    const Vec3d origin{k * 51.2, -k * 51.2, 0};
    const Camera camera(model, {rotation_from_yaw_pitch_roll(0, -90, 0), snap_position(origin + offset)});
    const Vec3d relative = camera.relative_to(origin).pose().center;
    EXPECT_EQ(relative, snap_position(relative));
    EXPECT_NEAR(relative.x, offset.x, 0x1p-20);
    EXPECT_NEAR(relative.y, offset.y, 0x1p-20);
  }
}

TEST(GimbalAngles, lead_back_to_the_rotation_they_came_from) {
  for (double yaw = -179; yaw < 180; yaw += 23)
    for (double pitch = -120; pitch <= 90; pitch += 15)
      for (double roll = -80; roll <= 80; roll += 20) {
        const Mat3d r = rotation_from_yaw_pitch_roll(yaw, pitch, roll);
        const GimbalAngles a = yaw_pitch_roll_from_rotation(r);
        const Mat3d again = rotation_from_yaw_pitch_roll(a.yaw_deg, a.pitch_deg, a.roll_deg);
        for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(again.m[k], r.m[k], 1e-9) << yaw << " " << pitch << " " << roll;
      }
}

TEST(GimbalAngles, of_a_camera_that_looks_about_straight_down_are_those_it_was_given) {
  for (const double pitch : {-88.5, -91.5}) {
    const GimbalAngles a = yaw_pitch_roll_from_rotation(rotation_from_yaw_pitch_roll(37, pitch, 1.5));
    EXPECT_NEAR(a.yaw_deg, 37, 1e-9);
    EXPECT_NEAR(a.pitch_deg, pitch, 1e-9);
    EXPECT_NEAR(a.roll_deg, 1.5, 1e-9);
  }
}

TEST(GimbalAngles, at_the_vertical_have_no_roll) {
  for (const double pitch : {-90., 90.}) {
    const GimbalAngles a = yaw_pitch_roll_from_rotation(rotation_from_yaw_pitch_roll(30, pitch, 0));
    EXPECT_NEAR(a.yaw_deg, 30, 1e-9);
    EXPECT_EQ(a.pitch_deg, pitch);
    EXPECT_EQ(a.roll_deg, 0);
  }
}

}  // namespace
}  // namespace skysweep::camera
