// SPDX-License-Identifier: Apache-2.0
#include "camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"

namespace skysweep::camera {
namespace {

CameraModel model_with(const Distortion& lens) { return {4000, 3000, 2950, 3010, 2017.3, 1466.8, lens}; }

// Lenses that can be inverted over the whole photograph; the corner lies at a normalised radius of about 0.85.
const std::vector<Distortion> kLenses = {
    {},                                      // none
    {-0.40, 0.20, 0, 0, 0},                  // strong barrel
    {0.15, -0.05, 0, 0, 0.01},               // pincushion
    {0, 0, 0.01, -0.02, 0},                  // decentred only
    {-0.11, 0.02, 0.001, -0.0005, -0.0003},  // a drone's
    {-0.15, 0, 0, 0, 0},                     // folds at radius 1.49, where the image is 0.99 wide
};

Vec3d point_at(const Camera& camera, Vec2d pixel, double distance) {
  return camera.pose().center + distance * *camera.ray(pixel);
}

TEST(Camera, pixels_of_a_nadir_camera_are_as_worked_out_by_hand) {
  // 100 m above the ground with f = 1000 px: 1 m on the ground is 10 px. Top of the photograph to the east.
  const CameraModel model{800, 600, 1000, 1000, 400, 300, {}};
  const Camera camera(model, {rotation_from_yaw_pitch_roll(90, -90, 0), {50, 20, 100}});
  EXPECT_EQ(camera.project({50, 20, 0}), (Vec2d{400, 300}));
  EXPECT_EQ(camera.project({53, 20, 0}), (Vec2d{400, 270}));  // 3 m east: up in the photograph
  EXPECT_EQ(camera.project({50, 18, 0}), (Vec2d{420, 300}));  // 2 m south: right
  EXPECT_EQ(camera.project({53, 20, 50}), (Vec2d{400, 240}));
  EXPECT_EQ(camera.depth({53, 18, 20}), 80);
  EXPECT_EQ(camera.gsd(80), 0.08);
}

TEST(Camera, shows_its_border_and_nothing_beyond) {
  const Camera camera(model_with({}), {});
  EXPECT_TRUE(camera.shows({0, 0}));
  EXPECT_TRUE(camera.shows({4000, 3000}));
  EXPECT_FALSE(camera.shows({-0.001, 10}));
  EXPECT_FALSE(camera.shows({10, 3000.001}));
}

TEST(Camera, sees_nothing_behind_itself) {
  const Camera camera(model_with({}), {rotation_from_yaw_pitch_roll(0, -90, 0), {0, 0, 100}});
  EXPECT_FALSE(camera.project({0, 0, 101}));
  EXPECT_FALSE(camera.project({5, 0, 100}));  // in the plane of the CoP
  EXPECT_TRUE(camera.project({0, 0, 99}));
}

TEST(Camera, ray_and_projection_are_inverse_over_the_whole_photograph) {
  for (const Distortion& lens : kLenses) {
    const Camera camera(model_with(lens), {rotation_from_yaw_pitch_roll(37, -65, 4), {0, 0, 0}});
    double worst_px = 0;
    for (int row = 0; row <= 60; ++row)
      for (int column = 0; column <= 80; ++column) {
        const Vec2d pixel{50.0 * column, 50.0 * row};
        ASSERT_TRUE(camera.ray(pixel)) << "k1 " << lens.k1 << " at " << pixel.x << ", " << pixel.y;
        EXPECT_NEAR(norm(*camera.ray(pixel)), 1, 1e-15);
        const auto back = camera.project(point_at(camera, pixel, 1));
        ASSERT_TRUE(back);
        worst_px = std::max(worst_px, norm(*back - pixel));
      }
    EXPECT_LT(worst_px, 1e-9) << "k1 " << lens.k1;
  }
}

TEST(Camera, points_on_one_ray_share_one_pixel) {
  const Camera camera(model_with(kLenses[1]), {rotation_from_yaw_pitch_roll(10, -80, 0), {10, 20, 120}});
  const Vec2d pixel{123.25, 2876.5};
  for (const double distance : {0.5, 10.0, 120.0, 1e4})
    EXPECT_LT(norm(*camera.project(point_at(camera, pixel, distance)) - pixel), 1e-8);
}

TEST(Camera, at_height_lies_on_the_plane_and_projects_back) {
  const Camera camera(model_with(kLenses[4]), {rotation_from_yaw_pitch_roll(-120, -60, 3), {10, 20, 120}});
  for (const double z : {-30.0, 0.0, 60.0, 119.0}) {
    const auto point = camera.at_height({700, 2100}, z);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->z, z);
    EXPECT_LT(norm(*camera.project(*point) - Vec2d{700, 2100}), 1e-8);
  }
}

TEST(Camera, a_ray_never_meets_a_plane_behind_it_or_parallel_to_it) {
  const CameraModel model{800, 600, 1000, 1000, 400, 300, {}};
  const Camera down(model, {rotation_from_yaw_pitch_roll(0, -90, 0), {0, 0, 100}});
  EXPECT_FALSE(down.at_height({400, 300}, 100));
  EXPECT_FALSE(down.at_height({400, 300}, 150));
  const Camera level(model, {rotation_from_yaw_pitch_roll(0, 0, 0), {0, 0, 100}});
  EXPECT_FALSE(level.at_height({400, 300}, 0));
  EXPECT_FALSE(level.at_height({400, 200}, 0));  // above the horizon
  EXPECT_TRUE(level.at_height({400, 400}, 0));
}

TEST(Lens, fold_radius_is_where_the_polynomial_stops_growing) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fold_radius_squared({}), kNever);
  EXPECT_EQ(fold_radius_squared({0.1, 0.2, 0.01, 0.01, 0.3}), kNever);  // grows for ever
  EXPECT_NEAR(fold_radius_squared({-0.15, 0, 0, 0, 0}), 1 / 0.45, 1e-12);
  // 1 - 1.2 u + u^2 has no real root: strong barrel that never folds.
  EXPECT_EQ(fold_radius_squared({-0.40, 0.20, 0, 0, 0}), kNever);
  // 1 - 1.5 u + 0.5 u^2 = (1 - u)(1 - u/2): the nearer root counts.
  EXPECT_NEAR(fold_radius_squared({-0.5, 0.1, 0, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(fold_radius_squared({0, 0, 0, 0, -1.0 / 7}), 1, 1e-12);
}

TEST(Lens, undistort_inverts_distort_up_to_the_fold) {
  Random random(17);
  for (const Distortion& lens : {Distortion{-0.15, 0, 0, 0, 0}, Distortion{-0.5, 0.1, 0, 0, 0},
                                 Distortion{0.3, -0.2, 0, 0, 0}, Distortion{0, 0, 0, 0, -1.0 / 7}}) {
    const double fold = std::sqrt(fold_radius_squared(lens));
    for (const double share : {0.0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.999999}) {
      const double angle = random.uniform(0, 6.28);
      const Vec2d p = share * fold * Vec2d{std::cos(angle), std::sin(angle)};
      const Vec2d distorted = distort(lens, p);
      const auto back = undistort(lens, distorted);
      ASSERT_TRUE(back) << "k1 " << lens.k1 << " at " << share << " of the fold";
      // Near the fold the inverse is ill-conditioned, the image of it is not.
      EXPECT_LT(norm(distort(lens, *back) - distorted), 1e-13) << "k1 " << lens.k1 << " at " << share << " of the fold";
      if (share < 0.995) {
        EXPECT_LT(norm(*back - p), 1e-11);
      }
    }
  }
}

TEST(Lens, undistort_says_nothing_beyond_the_fold) {
  for (const Distortion& lens :
       {Distortion{-0.15, 0, 0, 0, 0}, Distortion{-0.5, 0.1, 0, 0, 0}, Distortion{0, 0, 0, 0, -1.0 / 7}}) {
    const double fold = std::sqrt(fold_radius_squared(lens));
    const double widest = distort(lens, {fold, 0}).x;
    for (const double share : {1.0001, 1.01, 1.5, 10.0}) EXPECT_FALSE(undistort(lens, {0, share * widest})) << share;
  }
}

TEST(Lens, a_direction_beyond_the_fold_has_no_pixel) {
  // Beyond the fold the polynomial runs backwards into the photograph: a point far aside would appear in it.
  const CameraModel model = model_with({-0.5, 0.1, 0, 0, 0});
  const Camera camera(model, {});
  EXPECT_TRUE(camera.project({0.99, 0, 1}));
  EXPECT_FALSE(camera.project({1.01, 0, 1}));
  EXPECT_FALSE(camera.project({1.5, 0, 1}));
}

TEST(CameraModel, sensor_size_gives_the_focal_length_in_pixels) {
  const CameraModel model = camera_from_sensor(8.8, 13.2, 5472, 3648);
  EXPECT_DOUBLE_EQ(model.focal_px(), 3648);
  EXPECT_EQ(model.cx_px, 2736);
  EXPECT_EQ(model.cy_px, 1824);
  EXPECT_FALSE(model.problem());
}

TEST(CameraModel, says_what_is_wrong_with_it) {
  const CameraModel good = model_with({});
  EXPECT_FALSE(good.problem());
  const auto problem_with = [&](auto change) {
    CameraModel model = good;
    change(model);
    return model.problem().value_or("");
  };
  EXPECT_NE(problem_with([](CameraModel& m) { m.width_px = 0; }).find("image size"), std::string::npos);
  EXPECT_NE(problem_with([](CameraModel& m) { m.fx_px = -1; }).find("focal length"), std::string::npos);
  EXPECT_NE(problem_with([](CameraModel& m) { m.fy_px = std::nan(""); }).find("focal length"), std::string::npos);
  EXPECT_NE(problem_with([](CameraModel& m) { m.cx_px = std::nan(""); }).find("principal point"), std::string::npos);
  EXPECT_NE(problem_with([](CameraModel& m) { m.distortion.p2 = std::nan(""); }).find("distortion"), std::string::npos);
}

}  // namespace
}  // namespace skysweep::camera
