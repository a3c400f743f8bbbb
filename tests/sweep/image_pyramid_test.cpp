// SPDX-License-Identifier: Apache-2.0
#include "sweep/image_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "sweep/local_normalization.h"

namespace skysweep::sweep {
namespace {

Array2d<Rgb8> random_image(int width, int height) {
  Random random(3);
  Array2d<Rgb8> image(width, height);
  for (Rgb8& p : image)
    p = {static_cast<std::uint8_t>(random.below(256)), static_cast<std::uint8_t>(random.below(256)),
         static_cast<std::uint8_t>(random.below(256))};
  return image;
}

TEST(ImagePyramid, luminance_is_the_weighted_sum_of_the_channels) {
  Array2d<Rgb8> image(2, 2, {200, 100, 50});
  const ImagePyramid pyramid(image);
  EXPECT_NEAR(pyramid.sample_luminance({1, 1}, 0), 0.212671 * 200 + 0.715160 * 100 + 0.072169 * 50, 1.0 / 256);
}

TEST(ImagePyramid, samples_a_linear_ramp_exactly_between_pixel_centres) {
  Array2d<Rgb8> image(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto grey = static_cast<std::uint8_t>(2 * x + y);
      image(x, y) = {grey, grey, grey};
    }
  const ImagePyramid pyramid(image);
  for (const Vec2d p : {Vec2d{10.5, 20.5}, {10.75, 20.5}, {33.2, 40.9}}) {
    EXPECT_NEAR(pyramid.sample_luminance(p, 0), 2 * (p.x - 0.5) + (p.y - 0.5), 0.01);
    // A mean of 2 x 2 pixels stands for the middle of its window: the ramp stays the same ramp.
    EXPECT_NEAR(pyramid.sample_luminance(p, 1), 2 * (p.x - 0.5) + (p.y - 0.5), 0.02);
  }
}

TEST(ImagePyramid, levels_end_at_one_pixel_and_keep_the_mean) {
  const ImagePyramid pyramid(random_image(64, 64));
  EXPECT_EQ(pyramid.levels(), 7);
  double mean = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) mean += pyramid.luminance(0).at(x, y) / 4096.0;
  EXPECT_NEAR(pyramid.luminance(6).at(0, 0), mean, 6);
}

TEST(ImagePyramid, photographs_one_pixel_wide_can_be_sampled) {
  const ImagePyramid pyramid(random_image(1, 9));
  for (int level = 0; level < pyramid.levels(); ++level)
    EXPECT_TRUE(std::isfinite(pyramid.sample_luminance({0.3, 8.9}, level))) << level;
}

TEST(ImagePyramid, says_beforehand_how_much_memory_it_takes) {
  EXPECT_EQ(ImagePyramid(random_image(33, 21)).bytes(), ImagePyramid::bytes_for(33, 21));
}

Array2d<std::uint16_t> scaled(const Array2d<std::uint16_t>& image, double gain, double offset) {
  Array2d<std::uint16_t> out(image.width(), image.height());
  for (std::size_t i = 0; i < image.size(); ++i)
    out.data()[i] = static_cast<std::uint16_t>(std::lround(gain * image.data()[i] + offset));
  return out;
}

TEST(LocalNormalization, forgets_exposure_and_contrast_where_there_is_texture) {
  Random random(5);
  Array2d<std::uint16_t> image(60, 40);
  for (auto& v : image) v = static_cast<std::uint16_t>(20000 + random.below(20000));
  Array2d<std::uint16_t> a = image, b = scaled(image, 1.2, 3000);
  normalize_locally(a, 4);
  normalize_locally(b, 4);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.data()[i], b.data()[i], 0.6 * kLuminanceScale);
}

TEST(LocalNormalization, makes_no_texture_of_a_bare_surface) {
  Array2d<std::uint16_t> image(30, 30, 31000);
  normalize_locally(image, 5);
  for (const auto v : image) EXPECT_EQ(v, 128 * kLuminanceScale);
}

TEST(LocalNormalization, agrees_with_the_formula_at_the_border_and_inside) {
  Random random(9);
  Array2d<std::uint16_t> image(17, 13);
  for (auto& v : image) v = static_cast<std::uint16_t>(random.below(65000));
  Array2d<std::uint16_t> out = image;
  constexpr int kRadius = 3;
  normalize_locally(out, kRadius);
  for (int y = 0; y < 13; ++y) {
    for (int x = 0; x < 17; ++x) {
      double sum = 0, square = 0, n = 0;
      for (int v = std::max(0, y - kRadius); v <= std::min(12, y + kRadius); ++v)
        for (int u = std::max(0, x - kRadius); u <= std::min(16, x + kRadius); ++u) {
          const double grey = image(u, v) / 256.0;
          sum += grey, square += grey * grey, ++n;
        }
      const double mean = sum / n, variance = square / n - mean * mean;
      const double expected = 128 + 20 * (image(x, y) / 256.0 - mean) / std::sqrt(variance + 9);
      EXPECT_NEAR(out(x, y) / 256.0, std::fmin(255, std::fmax(0, expected)), 0.01) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace skysweep::sweep
