// SPDX-License-Identifier: Apache-2.0
#include "sweep/heights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sweep/best_planes.h"
#include "sweep/smoothing.h"

namespace skysweep::sweep {
namespace {

SweepProblem one_cell(double dz_m) {
  SweepProblem problem;
  problem.grid = {1, 1, 1, {0, 0}};
  problem.dz_m = dz_m;
  problem.search_everywhere({-10, 10});
  return problem;
}

MatchResult match(int plane, float fraction, float bend, float cost = 2, float mean = 20) {
  MatchResult m(1, 1);
  m.plane(0, 0) = plane;
  m.cost(0, 0) = cost;
  m.mean_cost(0, 0) = mean;
  m.fraction(0, 0) = fraction;
  m.bend(0, 0) = bend;
  return m;
}

TEST(Heights, lie_at_the_vertex_of_the_parabola) {
  const Parabola p = parabola_through(5, 2, 3);  // 2 + 2 t^2 - t
  EXPECT_DOUBLE_EQ(p.vertex, 0.25);
  EXPECT_DOUBLE_EQ(p.bend, 4);
  const Heights heights = heights_from_matches(one_cell(0.5), match(-3, 0.25f, 4));
  EXPECT_FLOAT_EQ(heights.height_m(0, 0), -1.375f);
  EXPECT_TRUE(std::isnan(heights.sigma_m(0, 0))) << "set_sigma is asked for that";
}

TEST(Heights, nothing_is_known_without_a_distinct_minimum) {
  const float nan = std::nanf("");
  EXPECT_TRUE(std::isnan(heights_from_matches(one_cell(1), match(0, nan, nan)).height_m(0, 0)))
      << "at the end of the range";
  EXPECT_TRUE(std::isnan(heights_from_matches(one_cell(1), match(0, 0, 0)).height_m(0, 0))) << "flat";
  EXPECT_TRUE(std::isnan(heights_from_matches(one_cell(1), match(0, 0, 4, 50)).height_m(0, 0))) << "above max_cost";
  EXPECT_TRUE(std::isnan(heights_from_matches(one_cell(1), match(0, 0, 4, 19.5, 20)).height_m(0, 0)))
      << "as bad as any";
  EXPECT_FALSE(std::isnan(heights_from_matches(one_cell(1), match(0, 0, 4)).height_m(0, 0)));
}

TEST(Heights, three_costs_on_a_line_have_no_vertex) {
  EXPECT_TRUE(std::isnan(parabola_through(3, 2, 1).vertex));
  EXPECT_TRUE(std::isnan(parabola_through(2, 2, 2).vertex));
  EXPECT_TRUE(std::isnan(parabola_through(std::numeric_limits<double>::infinity(), 2, 3).vertex));
}

TEST(BestPlanes, the_lowest_of_equal_planes_wins) {
  const SweepProblem problem = one_cell(1);
  CostVolume costs(problem, 500);
  for (const int k : {-4, 3}) costs.cell(0, 0)[k + 10] = 100;
  EXPECT_EQ(best_planes(costs, costs).plane(0, 0), -4);
}

TEST(Smoothing, carries_a_height_across_cells_that_cannot_decide) {
  SweepProblem problem;
  problem.grid = {21, 1, 1, {0, 0}};
  problem.search_everywhere({0, 20});
  CostVolume costs(problem, 640);
  for (const int x : {0, 1, 2, 18, 19, 20}) costs.cell(x, 0)[7] = 64;
  const MatchResult m = best_planes(costs, smooth(problem, costs, Backend::reference));
  for (int x = 0; x < 21; ++x) EXPECT_EQ(m.plane(x, 0), 7) << x;
}

TEST(Smoothing, lets_a_clear_step_be) {
  SweepProblem problem;
  problem.grid = {20, 20, 1, {0, 0}};
  problem.search_everywhere({0, 30});
  CostVolume costs(problem, 1000);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) costs.cell(x, y)[x < 10 ? 4 : 25] = 50;
  const MatchResult m = best_planes(costs, smooth(problem, costs, Backend::reference));
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) EXPECT_EQ(m.plane(x, y), x < 10 ? 4 : 25) << x << " " << y;
}

TEST(CostVolume, costs_are_rounded_to_units_and_limited) {
  EXPECT_EQ(quantized_cost(0), 0);
  EXPECT_EQ(quantized_cost(1), 1 << 20);
  EXPECT_EQ(quantized_cost(1e9), kWorstCost);
  EXPECT_EQ(quantized_cost(std::numeric_limits<double>::infinity()), kWorstCost);
}

}  // namespace
}  // namespace skysweep::sweep
