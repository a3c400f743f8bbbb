// SPDX-License-Identifier: Apache-2.0
#include "sweep/window_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

Array2d<float> noise(std::uint64_t seed, double contrast = 60) {
  Random random(seed);
  Array2d<float> image(23, 17);
  for (float& value : image) value = static_cast<float>(128 + contrast * random.uniform(-1.0, 1.0));
  return image;
}

// From the definition, window by window.
std::optional<double> correlation(const Array2d<float>& a, const Array2d<float>& b, int x, int y) {
  constexpr int kRadius = WindowCorrelation::kRadius;
  if (x < kRadius || y < kRadius || x + kRadius >= a.width() || y + kRadius >= a.height()) return std::nullopt;
  const auto mean = [&](auto value) {
    double sum = 0;
    for (int dy = -kRadius; dy <= kRadius; ++dy)
      for (int dx = -kRadius; dx <= kRadius; ++dx) sum += value(x + dx, y + dy);
    return sum / 25;
  };
  const double mean_a = mean([&](int u, int v) { return a(u, v); }),
               mean_b = mean([&](int u, int v) { return b(u, v); });
  const double aa = mean([&](int u, int v) { return std::pow(a(u, v) - mean_a, 2); });
  const double bb = mean([&](int u, int v) { return std::pow(b(u, v) - mean_b, 2); });
  if (!(aa > 1 && bb > 1)) return std::nullopt;
  return mean([&](int u, int v) { return (a(u, v) - mean_a) * (b(u, v) - mean_b); }) / std::sqrt(aa * bb);
}

// Returns how many pixels have a correlation.
int compare_with_definition(const Array2d<float>& a, const Array2d<float>& b) {
  Array2d<float> sum(a.width(), a.height(), 0), count(a.width(), a.height(), 0);
  WindowCorrelation(a).add(b, sum, count);
  int known = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const auto expected = correlation(a, b, x, y);
      EXPECT_EQ(count(x, y), expected ? 1 : 0) << x << ", " << y;
      EXPECT_NEAR(sum(x, y), expected.value_or(0), 1e-6) << x << ", " << y;
      known += expected.has_value();
    }
  }
  return known;
}

TEST(WindowCorrelation, is_that_of_the_definition) { EXPECT_EQ(compare_with_definition(noise(1), noise(2)), 19 * 13); }

TEST(WindowCorrelation, does_not_mind_exposure) {
  const Array2d<float> image = noise(1);
  Array2d<float> darker = image;
  for (float& value : darker) value = 0.5f * value + 10;
  Array2d<float> sum(image.width(), image.height(), 0), count = sum;
  WindowCorrelation(image).add(darker, sum, count);
  EXPECT_NEAR(sum(8, 8), 1, 1e-6);
}

TEST(WindowCorrelation, knows_nothing_where_a_window_is_partly_unknown) {
  Array2d<float> holed = noise(2);
  holed(9, 8) = std::nanf("");
  EXPECT_EQ(compare_with_definition(noise(1), holed), 19 * 13 - 25);
}

TEST(WindowCorrelation, knows_nothing_without_texture) {
  EXPECT_EQ(compare_with_definition(noise(1), noise(2, 0.1)), 0);
  EXPECT_EQ(compare_with_definition(noise(1, 0.1), noise(2)), 0);
}

TEST(WindowCorrelation, of_images_smaller_than_a_window_is_none) {
  const Array2d<float> small(4, 30, 128);
  EXPECT_EQ(compare_with_definition(small, small), 0);
}

}  // namespace
}  // namespace skysweep::sweep
