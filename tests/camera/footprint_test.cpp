// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "camera/camera.h"
#include "core/random.h"

namespace skysweep::camera {
namespace {

// 60 degrees of view across: tan(30 degrees) = 400 / focal.
const double kFocalPx = 400 * std::numbers::sqrt3;
const CameraModel kModel{800, 600, kFocalPx, kFocalPx, 400, 300, {}};
constexpr double kFar = 1e6;

Camera camera_at(double yaw_deg, double pitch_deg, Vec3d center, const CameraModel& model = kModel) {
  return {model, {rotation_from_yaw_pitch_roll(yaw_deg, pitch_deg, 0), center}};
}

double area(const std::vector<Vec2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

Box2d bounds(const std::vector<Vec2d>& polygon) {
  Box2d box;
  for (const Vec2d p : polygon) box.extend(p);
  return box;
}

// Inside the convex, counter-clockwise polygon or nearer to it than `slack_m`.
bool contains(const std::vector<Vec2d>& polygon, Vec2d p, double slack_m) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (cross(edge, p - polygon[i]) < -slack_m * norm(edge)) return false;
  }
  return !polygon.empty();
}

TEST(Footprint, of_a_nadir_camera_is_its_format_scaled_by_height_over_focal_length) {
  const std::vector<Vec2d> polygon = footprint(camera_at(0, -90, {1000, 2000, 110}), 10, 10, kFar);
  const double half_width = 100 * 400 / kFocalPx, half_height = 100 * 300 / kFocalPx;
  const Box2d box = bounds(polygon);
  EXPECT_NEAR(box.min.x, 1000 - half_width, 1e-9);
  EXPECT_NEAR(box.max.x, 1000 + half_width, 1e-9);
  EXPECT_NEAR(box.min.y, 2000 - half_height, 1e-9);
  EXPECT_NEAR(box.max.y, 2000 + half_height, 1e-9);
  EXPECT_NEAR(area(polygon), 4 * half_width * half_height, 1e-6);  // positive: counter-clockwise
}

TEST(Footprint, of_a_tilted_camera_is_the_trapezium_of_its_corner_rays) {
  // Looking 30 degrees away from nadir to the north; half the vertical field of view is atan(300 / f).
  const double half_angle = std::atan(300 / kFocalPx), tilt = std::numbers::pi / 6;
  const std::vector<Vec2d> polygon = footprint(camera_at(0, -60, {0, 0, 100}), 0, 0, kFar);
  const double near_y = 100 * std::tan(tilt - half_angle), far_y = 100 * std::tan(tilt + half_angle);
  // Half width of a row of the photograph on the ground: 400 / f times its depth along the view direction.
  const double far_depth = 100 * std::cos(tilt) + far_y * std::sin(tilt);
  const double near_depth = 100 * std::cos(tilt) + near_y * std::sin(tilt);
  const double far_half = far_depth * 400 / kFocalPx, near_half = near_depth * 400 / kFocalPx;
  EXPECT_NEAR(bounds(polygon).min.y, near_y, 1e-9);
  EXPECT_NEAR(bounds(polygon).max.y, far_y, 1e-9);
  EXPECT_NEAR(bounds(polygon).max.x, far_half, 1e-9);
  EXPECT_NEAR(bounds(polygon).min.x, -far_half, 1e-9);
  EXPECT_NEAR(area(polygon), (far_y - near_y) * (near_half + far_half), 1e-6);
}

TEST(Footprint, turns_with_the_yaw) {
  const std::vector<Vec2d> north = footprint(camera_at(0, -60, {0, 0, 100}), 0, 0, kFar);
  const std::vector<Vec2d> east = footprint(camera_at(90, -60, {0, 0, 100}), 0, 0, kFar);
  EXPECT_NEAR(bounds(east).max.x, bounds(north).max.y, 1e-9);
  EXPECT_NEAR(bounds(east).max.y, bounds(north).max.x, 1e-9);
  EXPECT_NEAR(area(east), area(north), 1e-6);
}

TEST(Footprint, between_two_heights_covers_the_footprints_of_both) {
  const Camera camera = camera_at(20, -50, {0, 0, 100});
  const std::vector<Vec2d> both = footprint(camera, 0, 40, kFar);
  for (const double z : {0.0, 20.0, 40.0})
    for (const Vec2d p : footprint(camera, z, z, kFar)) EXPECT_TRUE(contains(both, p, 1e-9)) << "at height " << z;
}

TEST(Footprint, contains_all_ground_that_the_photograph_shows_within_the_distance) {
  Random random(23);
  CameraModel barrel = kModel;
  barrel.distortion = {-0.3, 0.1, 0, 0, 0};
  for (int trial = 0; trial < 60; ++trial) {
    const Camera camera =
        camera_at(random.uniform(-180, 180), random.uniform(-90, 15), {0, 0, 100}, trial % 2 == 0 ? kModel : barrel);
    constexpr double kDistance = 500;
    const std::vector<Vec2d> polygon = footprint(camera, 0, 0, kDistance);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d p{random.uniform(-kDistance, kDistance), random.uniform(-kDistance, kDistance), 0};
      const auto pixel = camera.project(p);
      if (!pixel || !camera.shows(*pixel) || norm(p - camera.pose().center) > kDistance) continue;
      // The outline is a polygon of curves: allow for the sagitta of its longest pieces.
      EXPECT_TRUE(contains(polygon, {p.x, p.y}, 0.01 * kDistance)) << "trial " << trial << ": " << p.x << ", " << p.y;
    }
  }
}

TEST(Footprint, of_a_camera_that_shows_the_horizon_ends_at_the_distance) {
  // Level to the north from 100 m: the lower border meets the ground at f / 300 times the height.
  const std::vector<Vec2d> polygon = footprint(camera_at(0, 0, {0, 0, 100}), 0, 0, 1000);
  EXPECT_NEAR(bounds(polygon).min.y, 100 * kFocalPx / 300, 1e-9);
  EXPECT_NEAR(bounds(polygon).max.y, 1000, 10);
  for (const Vec2d p : polygon) EXPECT_LE(norm(p), 1000 + 1e-9);
  // Straight ahead to 1000 m, 30 degrees to either side.
  EXPECT_TRUE(contains(polygon, {0, 990}, 0));
  EXPECT_TRUE(contains(polygon, {-450, 800}, 0));
  EXPECT_FALSE(contains(polygon, {-600, 800}, 0));
}

TEST(Footprint, is_empty_where_there_is_no_ground_to_see) {
  EXPECT_TRUE(footprint(camera_at(0, -90, {0, 0, 10}), 10, 10, kFar).empty());
  EXPECT_TRUE(footprint(camera_at(0, -90, {0, 0, 5}), 10, 20, kFar).empty());
  EXPECT_TRUE(footprint(camera_at(0, 80, {0, 0, 100}), 0, 0, kFar).empty());  // looks at the sky
}

TEST(ViewPyramidBox, spans_from_the_cop_to_the_ground) {
  const Camera camera = camera_at(0, -60, {10, 20, 100});
  const Box3d box = view_pyramid_box(camera, 5, kFar);
  const Box2d ground = bounds(footprint(camera, 5, 5, kFar));
  EXPECT_EQ(box.min.z, 5);
  EXPECT_EQ(box.max.z, 100);
  EXPECT_EQ(box.min.x, ground.min.x);
  EXPECT_EQ(box.max.x, ground.max.x);
  EXPECT_EQ(box.min.y, std::min(ground.min.y, 20.0));
  EXPECT_EQ(box.max.y, ground.max.y);
}

TEST(ViewClass, changes_at_its_borders) {
  const auto class_at = [](double off_nadir) { return classify(camera_at(70, -90 + off_nadir, {0, 0, 100}), 40); };
  EXPECT_EQ(class_at(0), ViewClass::vertical);
  EXPECT_EQ(class_at(2.99), ViewClass::vertical);
  EXPECT_EQ(class_at(3.01), ViewClass::near_vertical);
  EXPECT_EQ(class_at(39.99), ViewClass::near_vertical);
  EXPECT_EQ(class_at(40.01), ViewClass::oblique);
  // The upper border shows the horizon once the tilt and half the field of view reach 90 degrees.
  const double half_view = std::atan(300 / kFocalPx) * 180 / std::numbers::pi;
  EXPECT_EQ(class_at(90 - half_view - 0.01), ViewClass::oblique);
  EXPECT_EQ(class_at(90 - half_view + 0.01), ViewClass::high_oblique);
  EXPECT_EQ(class_at(90), ViewClass::high_oblique);
}

TEST(OffNadir, is_the_angle_of_the_view_direction_whatever_the_yaw_and_roll) {
  for (const double angle : {0.0, 0.001, 3.0, 45.0, 90.0, 150.0})
    EXPECT_NEAR(off_nadir_deg({rotation_from_yaw_pitch_roll(123, -90 + angle, 45), {}}), angle, 1e-9) << angle;
}

}  // namespace
}  // namespace skysweep::camera
