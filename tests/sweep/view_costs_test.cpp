// SPDX-License-Identifier: Apache-2.0
#include "sweep/view_costs.h"

#include <gtest/gtest.h>

#include <limits>

namespace skysweep::sweep {
namespace {

ViewSamples samples_of(std::initializer_list<double> grey) {
  ViewSamples samples;
  samples.levels = 1;
  for (const double g : grey) samples.luminance[0][samples.count++] = g;
  return samples;
}

SweepOptions options_of(Aggregation aggregation) {
  SweepOptions options;
  options.aggregation = aggregation;
  options.few_views_penalty = 0;
  return options;
}

TEST(MatchingCost, of_all_views_is_the_mean_difference_of_all_pairs) {
  // Pairs of 10, 14, 20: 4, 10, 6.
  EXPECT_DOUBLE_EQ(matching_cost(samples_of({10, 14, 20}), options_of(Aggregation::all_views)), 20.0 / 3);
}

TEST(MatchingCost, of_the_better_half_is_the_mean_of_the_lowest_view_costs) {
  // C = {7, 5, 8}; floor(3 / 2) = 1.
  EXPECT_DOUBLE_EQ(matching_cost(samples_of({10, 14, 20}), options_of(Aggregation::better_half)), 5);
}

TEST(MatchingCost, of_the_consensus_does_not_see_hidden_views) {
  // Three views agree, two are hidden by something else each.
  const ViewSamples samples = samples_of({100, 101, 102, 30, 220});
  EXPECT_NEAR(matching_cost(samples, options_of(Aggregation::consensus)), 4.0 / 3, 1e-12);
  EXPECT_GT(matching_cost(samples, options_of(Aggregation::better_half)), 20);
}

TEST(MatchingCost, grows_when_fewer_views_show_the_point) {
  SweepOptions options = options_of(Aggregation::consensus);
  options.few_views_penalty = 6;
  EXPECT_DOUBLE_EQ(matching_cost(samples_of({50, 50}), options), 3);
  EXPECT_DOUBLE_EQ(matching_cost(samples_of({50, 50, 50, 50}), options), 1.5);
}

TEST(MatchingCost, does_not_exist_with_too_few_views) {
  SweepOptions options;
  options.min_views = 3;
  EXPECT_EQ(matching_cost(samples_of({50, 50}), options), std::numeric_limits<double>::infinity());
  EXPECT_EQ(matching_cost(samples_of({50}), SweepOptions{}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace skysweep::sweep
