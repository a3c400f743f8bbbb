// SPDX-License-Identifier: Apache-2.0
#include "report/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skysweep::report {
namespace {

TEST(Quantile, interpolates_between_order_statistics) {
  std::vector<float> values = {40, 10, 30, 20};
  EXPECT_DOUBLE_EQ(quantile(values, 0), 10);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 25);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 37);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 40);
}

TEST(Quantile, of_one_value_is_the_value_and_of_none_is_nan) {
  std::vector<float> one = {7}, none;
  EXPECT_DOUBLE_EQ(quantile(one, 0.3), 7);
  EXPECT_TRUE(std::isnan(quantile(none, 0.5)));
}

}  // namespace
}  // namespace skysweep::report
