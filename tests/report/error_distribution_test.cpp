// SPDX-License-Identifier: Apache-2.0
#include "report/error_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "rasters.h"

namespace skysweep::report {
namespace {

TEST(ErrorDistribution, every_height_falls_into_one_bin_or_beyond) {
  const std::vector<float> dz = {-4, -3, -2.95f, 0.05f, 3, 3.01f, 9, kHole};
  const ErrorDistribution d = error_distribution(dz, 10, 1, 3);  // bins of 0.1 m
  EXPECT_EQ(d.below, 1);
  EXPECT_EQ(d.above, 2);
  EXPECT_EQ(d.counts.front(), 2);
  EXPECT_EQ(d.counts[30], 1);
  EXPECT_EQ(d.counts.back(), 1);
  EXPECT_EQ(std::accumulate(d.counts.begin(), d.counts.end(), d.below + d.above), 7);
}

TEST(ErrorDistribution, holes_keep_the_cumulative_share_below_one) {
  const std::vector<float> dz = {0.05f, -0.15f, 0.5f, -1000};
  const ErrorDistribution d = error_distribution(dz, 8, 0.5, 1);
  ASSERT_EQ(d.cumulative.size(), 61u);
  EXPECT_NEAR(d.cumulative.front().error_m, 0.05, 1e-9);  // 0.1 GSD
  EXPECT_NEAR(d.cumulative[20].error_m, 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(d.cumulative[20].of_all, 3. / 8);  // 0.5 is at most 0.5
  EXPECT_NEAR(d.cumulative.back().error_m, 50, 1e-6);
  EXPECT_DOUBLE_EQ(d.cumulative.back().of_all, 3. / 8);
  for (std::size_t i = 1; i < d.cumulative.size(); ++i) EXPECT_GE(d.cumulative[i].of_all, d.cumulative[i - 1].of_all);
}

TEST(ErrorDistribution, without_reference_the_shares_are_no_numbers) {
  EXPECT_TRUE(std::isnan(error_distribution({}, 0, 1, 1).cumulative.front().of_all));
}

}  // namespace
}  // namespace skysweep::report
