// SPDX-License-Identifier: Apache-2.0
#include "report/distance_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace skysweep::report {
namespace {

float nearest_mark(const Array2d<std::uint8_t>& marked, int column, int row) {
  float nearest = std::numeric_limits<float>::infinity();
  for (int y = 0; y < marked.height(); ++y)
    for (int x = 0; x < marked.width(); ++x)
      if (marked(x, y)) {
        const auto dx = static_cast<float>(x - column), dy = static_cast<float>(y - row);
        nearest = std::min(nearest, dx * dx + dy * dy);
      }
  return nearest;
}

TEST(DistanceTransform, equals_the_search_of_all_marks) {
  Random random(5);
  for (const int one_in : {3, 40, 400, 3000})
    for (const auto& [width, height] : {std::pair{43, 29}, {1, 50}, {50, 1}}) {
      Array2d<std::uint8_t> marked(width, height);
      for (std::uint8_t& value : marked) value = random.below(one_in) == 0 ? 200 : 0;
      const Array2d<float> distance = squared_distance_to(marked);
      for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
          ASSERT_EQ(distance(column, row), nearest_mark(marked, column, row)) << column << ", " << row;
    }
}

TEST(DistanceTransform, without_a_mark_all_is_infinitely_far) {
  for (const float value : squared_distance_to(Array2d<std::uint8_t>(4, 3))) EXPECT_TRUE(std::isinf(value));
  EXPECT_TRUE(squared_distance_to({}).empty());
}

}  // namespace
}  // namespace skysweep::report
