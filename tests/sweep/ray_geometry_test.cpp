// SPDX-License-Identifier: Apache-2.0
#include "sweep/ray_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "camera/pose.h"

namespace skysweep::sweep {
namespace {

constexpr double kFlyingHeight = 30, kFocalPx = 300, kGsd = kFlyingHeight / kFocalPx;

// Views straight down from places over a grid of one block at height 0.
SweepProblem looked_at_from(const std::vector<Vec2d>& places) {
  SweepProblem problem;
  problem.grid = {kBlockCells, kBlockCells, 0.1, {-0.8, 0.8}};
  for (const Vec2d& place : places) {
    const camera::CameraModel model{320, 240, kFocalPx, kFocalPx, 160, 120, {}};
    const camera::Pose pose{camera::rotation_from_yaw_pitch_roll(0, -90, 0), {place.x, place.y, kFlyingHeight}};
    problem.views.push_back({nullptr, camera::Camera(model, pose), 0});
  }
  return problem;
}

double at_ground(const std::vector<Vec2d>& places) {
  return height_per_pixel(looked_at_from(places), Array2d<float>(kBlockCells, kBlockCells, 0))(0, 0);
}

TEST(RayGeometry, two_views_measure_a_height_as_their_parallax_does) {
  // z = H p / B with parallax p, the difference of two positions of one pixel each: sqrt 2 GSD H / B.
  const double half = 4, expected = std::sqrt(2) * kGsd * kFlyingHeight / (2 * half);
  EXPECT_NEAR(at_ground({{-half, 0}, {half, 0}}), expected, 0.01 * expected);
  EXPECT_NEAR(at_ground({{0, -half}, {0, half}}), expected, 0.01 * expected);
}

TEST(RayGeometry, more_views_and_longer_baselines_measure_it_better) {
  EXPECT_NEAR(at_ground({{-4, 0}, {4, 0}, {-4, 0}, {4, 0}}), at_ground({{-4, 0}, {4, 0}}) / std::sqrt(2), 1e-6);
  EXPECT_NEAR(at_ground({{-2, 0}, {2, 0}}), 2 * at_ground({{-4, 0}, {4, 0}}), 1e-3);
  EXPECT_NEAR(at_ground({{-4, 0}, {0, 0}, {4, 0}}), at_ground({{-4, 0}, {4, 0}}), 1e-3) << "the middle adds nothing";
}

TEST(RayGeometry, a_pixel_that_looks_aslant_covers_more_ground) {
  // Two views from 45 degrees on both sides, with the place in their middle: slope distance sqrt 2 H, cut aslant.
  SweepProblem problem = looked_at_from({});
  for (const double side : {-1.0, 1.0}) {
    const camera::CameraModel model{320, 240, kFocalPx, kFocalPx, 160, 120, {}};
    const camera::Pose pose{camera::rotation_from_yaw_pitch_roll(-90 * side, -45, 0),
                            {side * kFlyingHeight, 0, kFlyingHeight}};
    problem.views.push_back({nullptr, camera::Camera(model, pose), 0});
  }
  const double expected = 2 * kGsd / std::sqrt(2);
  EXPECT_NEAR(height_per_pixel(problem, Array2d<float>(kBlockCells, kBlockCells, 0))(0, 0), expected, 0.01 * expected);
}

TEST(RayGeometry, nothing_is_measured_by_one_view_one_place_or_where_nothing_is_known) {
  EXPECT_TRUE(std::isnan(at_ground({{0, 0}})));
  EXPECT_TRUE(std::isnan(at_ground({{0, 0}, {0, 0}})));
  EXPECT_TRUE(std::isnan(at_ground({{-100, 0}, {100, 0}}))) << "neither shows the place";
  const Array2d<float> nothing(kBlockCells, kBlockCells, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(std::isnan(height_per_pixel(looked_at_from({{-4, 0}, {4, 0}}), nothing)(0, 0)));
}

}  // namespace
}  // namespace skysweep::sweep
