// SPDX-License-Identifier: Apache-2.0
#include "sweep/similar_normalization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/random.h"
#include "sweep/backend.h"
#include "sweep/image_pyramid.h"
#include "sweep/local_normalization.h"

namespace skysweep::sweep {
namespace {

using Luminance = Array2d<std::uint16_t>;

constexpr int kGrey = static_cast<int>(kLuminanceScale);

Luminance random_image(int width, int height, int low_grey, int high_grey) {
  Luminance image(width, height);
  Random random(7);
  for (std::uint16_t& value : image)
    value = static_cast<std::uint16_t>(low_grey * kGrey + random.below((high_grey - low_grey) * kGrey));
  return image;
}

// A noisy image whose right half is brighter by `step` grey levels.
Luminance two_sides(int step) {
  Luminance image = random_image(30, 20, 40, 60);
  for (int y = 0; y < 20; ++y)
    for (int x = 15; x < 30; ++x) image(x, y) = static_cast<std::uint16_t>(image(x, y) + step * kGrey);
  return image;
}

Luminance normalized_similar(Luminance image, int radius = 2, int tolerance_grey = 30) {
  normalize_similar(image, radius, tolerance_grey * kGrey);
  return image;
}

// Y' = 128 + 20 (Y - m) / sqrt(s^2 + 3^2) over the similar pixels of the window, border repeated; plainly.
double by_formula(const Luminance& image, int column, int row, int radius, int tolerance_grey) {
  const auto at = [&](int x, int y) {
    return image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1)) / kLuminanceScale;
  };
  const double own = at(column, row);
  double n = 0, sum = 0, squares = 0;
  for (int y = row - radius; y <= row + radius; ++y) {
    for (int x = column - radius; x <= column + radius; ++x) {
      if (std::abs(at(x, y) - own) > tolerance_grey) continue;
      n += 1, sum += at(x, y), squares += at(x, y) * at(x, y);
    }
  }
  const double mean = sum / n;
  return std::clamp(128 + 20 * (own - mean) / std::sqrt(squares / n - mean * mean + 9), 0.0, 255.0);
}

TEST(SimilarNormalization, is_the_formula_over_the_similar_pixels_of_the_window) {
  const Luminance image = random_image(37, 19, 0, 255);
  for (const int radius : {1, 2, kLargestSimilarRadius}) {
    for (const int tolerance : {20, 80, 255}) {
      const Luminance normalized = normalized_similar(image, radius, tolerance);
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)  // squares are those of whole 1/16 grey levels, rounded down
          EXPECT_NEAR(normalized(x, y) / kLuminanceScale, by_formula(image, x, y, radius, tolerance), 0.6)
              << x << ", " << y << ", radius " << radius << ", tolerance " << tolerance;
    }
  }
}

TEST(SimilarNormalization, what_lies_beyond_an_edge_changes_nothing) {
  const Luminance dark = normalized_similar(two_sides(60)), bright = normalized_similar(two_sides(150));
  EXPECT_EQ(dark, bright);
  Luminance all_dark = two_sides(60), all_bright = two_sides(150);
  normalize_locally(all_dark, 2);
  normalize_locally(all_bright, 2);
  EXPECT_NE(all_dark(14, 10), all_bright(14, 10)) << "with all pixels of the window it does";
}

TEST(SimilarNormalization, exposure_changes_nothing) {
  Luminance brighter = random_image(20, 20, 40, 90);
  const Luminance usual = normalized_similar(brighter);
  for (std::uint16_t& value : brighter) value = static_cast<std::uint16_t>(value + 100 * kGrey);
  EXPECT_EQ(normalized_similar(brighter), usual);
}

TEST(SimilarNormalization, repeats_the_pixels_at_the_border) {
  const Luminance image = random_image(20, 14, 0, 255);
  constexpr int kMore = 3;
  Luminance larger(image.width() + 2 * kMore, image.height() + 2 * kMore);
  for (int y = 0; y < larger.height(); ++y)
    for (int x = 0; x < larger.width(); ++x)
      larger(x, y) = image(std::clamp(x - kMore, 0, image.width() - 1), std::clamp(y - kMore, 0, image.height() - 1));
  const Luminance inside = normalized_similar(larger, kMore, 60), whole = normalized_similar(image, kMore, 60);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) EXPECT_EQ(whole(x, y), inside(x + kMore, y + kMore)) << x << ", " << y;
}

TEST(SimilarNormalization, every_instruction_set_gives_the_same_values) {
  const std::string in_use = cpu_instruction_set_in_use();
  // Widths around those of the vectors.
  for (const int width : {1, 7, 16, 17, 61}) {
    const Luminance image = random_image(width, 11, 0, 255);
    const Luminance expected = normalized_similar(image, 3, 40);
    for (const std::string& name : cpu_instruction_sets()) {
      use_cpu_instruction_set(name);
      EXPECT_EQ(normalized_similar(image, 3, 40), expected) << name << ", width " << width;
    }
  }
  use_cpu_instruction_set(in_use);
}

TEST(SimilarNormalization, the_tolerance_of_a_photograph_is_a_setting) {
  Array2d<Rgb8> photograph(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) photograph(x, y) = x < 16 ? Rgb8{50, 50, 50} : Rgb8{150, 150, 150};
  SweepOptions options;
  const auto beside_the_edge = [&](int tolerance) {
    options.normalization_tolerance = tolerance;
    return ImagePyramid(photograph, options.normalization()).luminance(0).at(15, 16) / kLuminanceScale;
  };
  EXPECT_NEAR(beside_the_edge(80), 128, 0.01);  // level on its own side
  EXPECT_NEAR(beside_the_edge(120), beside_the_edge(0), 0.5);
  EXPECT_LT(beside_the_edge(0), 120);
}

TEST(SimilarNormalization, wrong_settings_are_refused_with_a_sentence) {
  SweepOptions options;
  for (const int tolerance : {-1, 256}) {
    options.normalization_tolerance = tolerance;
    EXPECT_EQ(options.problem().value_or(""), "normalization_tolerance must lie between 0 (off) and 255 grey levels");
  }
  options.normalization_tolerance = 80;
  options.normalization_radius_px = kLargestSimilarRadius + 1;
  EXPECT_EQ(options.problem().value_or(""),
            "a normalization_radius_px of more than 5 needs normalization_tolerance = 0: all pixels in the window "
            "count then");
  options.normalization_tolerance = 0;
  EXPECT_FALSE(options.problem());
}

}  // namespace
}  // namespace skysweep::sweep
