// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_warp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

ImagePyramid noise(int width, int height) {
  Random random(5);
  Array2d<Rgb8> image(width, height);
  for (Rgb8& pixel : image) pixel.r = pixel.g = pixel.b = static_cast<std::uint8_t>(random.uniform(0.0, 255.0));
  return ImagePyramid(image);
}

View view(const ImagePyramid& image, double yaw_deg, double pitch_deg, Vec3d center,
          const camera::Distortion& distortion = {-0.1, 0.02, 1e-3, -5e-4, 0}) {
  const camera::CameraModel model{image.width(),        image.height(),        200,       210,
                                  0.48 * image.width(), 0.53 * image.height(), distortion};
  return {&image, camera::Camera(model, {camera::rotation_from_yaw_pitch_roll(yaw_deg, pitch_deg, 3), center}), 0};
}

// Compares every pixel with what the cameras themselves say; returns how many of them the neighbour shows.
int compare_with_cameras(const View& reference, const View& neighbour, int level, double depth) {
  const PixelRays rays(reference, level);
  Array2d<float> warped(rays.width, rays.height);
  PlaneWarp(rays, neighbour).warp(depth, warped);
  int shown = 0;
  for (int y = 0; y < warped.height(); ++y) {
    for (int x = 0; x < warped.width(); ++x) {
      const Vec2d pixel = std::ldexp(1.0, level) * Vec2d{x + 0.5, y + 0.5};
      const auto point = reference.camera.at_height(pixel, reference.camera.pose().center.z - depth);
      const auto seen = point ? neighbour.camera.project(*point) : std::nullopt;
      const bool shows = seen && neighbour.camera.shows(*seen);
      EXPECT_EQ(shows, !std::isnan(warped(x, y))) << x << ", " << y;
      if (!shows) continue;
      EXPECT_NEAR(warped(x, y), neighbour.image->sample_luminance(*seen, level), 1e-4);
      ++shown;
    }
  }
  return shown;
}

TEST(PlaneWarp, places_pixels_where_the_cameras_do) {
  const ImagePyramid image = noise(160, 120);
  const View reference = view(image, 20, -88, {1, 2, 100});
  const View neighbour = view(image, 200, -86, {12, -5, 103});
  for (const double depth : {20., 100., 1000.}) EXPECT_GT(compare_with_cameras(reference, neighbour, 1, depth), 500);
}

TEST(PlaneWarp, knows_nothing_above_the_horizon_nor_behind_the_neighbour) {
  const ImagePyramid image = noise(160, 120);
  const View level_view = view(image, 0, -10, {0, 0, 100}, {});
  const View below = view(image, 0, -90, {0, 250, 70}, {});
  const int shown = compare_with_cameras(level_view, below, 0, 60);
  EXPECT_GT(shown, 0);
  EXPECT_LT(shown, 160 * 120 / 2);
  EXPECT_EQ(compare_with_cameras(level_view, below, 0, 20), 0);
}

}  // namespace
}  // namespace skysweep::sweep
