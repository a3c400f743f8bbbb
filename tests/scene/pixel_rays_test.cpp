// SPDX-License-Identifier: Apache-2.0
#include "scene/render/pixel_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "camera/camera.h"

namespace skysweep::scene {
namespace {

void expect_rays_of_camera(const camera::CameraModel& model, double tolerance_px) {
  const PixelRays rays(model);
  const camera::Camera camera(model, {});
  for (int row = 0; row < model.height_px; row += 37)
    for (int column = 0; column < model.width_px; column += 41) {
      ASSERT_TRUE(rays.valid(column, row));
      const auto pixel = camera.project(rays.direction(column, row, {0.3, 0.8}));
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x, column + 0.3, tolerance_px);
      EXPECT_NEAR(pixel->y, row + 0.8, tolerance_px);
    }
}

TEST(PixelRays, project_back_to_their_pixel_without_distortion) {
  expect_rays_of_camera({640, 480, 700, 710, 318, 244, {}}, 1e-9);
}

TEST(PixelRays, project_back_to_their_pixel_through_a_strongly_distorting_lens) {
  expect_rays_of_camera({640, 480, 500, 505, 330, 235, {-0.25, 0.08, 0.001, -0.0007, -0.01}}, 5e-4);
}

TEST(PixelRays, pixels_beyond_the_fold_of_the_lens_are_not_valid) {
  const PixelRays rays({640, 480, 300, 300, 320, 240, {-0.5, 0, 0, 0, 0}});
  EXPECT_TRUE(rays.valid(320, 240));
  EXPECT_FALSE(rays.valid(0, 0));
}

}  // namespace
}  // namespace skysweep::scene
