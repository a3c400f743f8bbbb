// SPDX-License-Identifier: Apache-2.0
#include "sweep/window_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

TEST(WindowStatistics, are_those_of_the_values_counted_one_by_one) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Array2d<float> values(23, 17);
  Random random(3);
  for (float& v : values) v = random.uniform(0, 1) < 0.3 ? kNaN : static_cast<float>(1000 + random.normal());
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) values(x, y) = kNaN;  // a window without any
  for (const int radius : {0, 1, 4}) {
    const Array2d<float> mean = window_mean(values, radius), range = window_range(values, radius);
    for (int y = 0; y < values.height(); ++y) {
      for (int x = 0; x < values.width(); ++x) {
        double sum = 0, count = 0;
        float low = std::numeric_limits<float>::infinity(), high = -low;
        for (int v = std::max(0, y - radius); v <= std::min(values.height() - 1, y + radius); ++v) {
          for (int u = std::max(0, x - radius); u <= std::min(values.width() - 1, x + radius); ++u) {
            if (std::isnan(values(u, v))) continue;
            sum += values(u, v), count += 1;
            low = std::min(low, values(u, v)), high = std::max(high, values(u, v));
          }
        }
        if (count == 0) {
          EXPECT_TRUE(std::isnan(mean(x, y)) && std::isnan(range(x, y)));
          continue;
        }
        EXPECT_NEAR(mean(x, y), sum / count, 1e-4);
        EXPECT_EQ(range(x, y), high - low);
      }
    }
  }
}

}  // namespace
}  // namespace skysweep::sweep
