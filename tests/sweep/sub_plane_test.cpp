// SPDX-License-Identifier: Apache-2.0
#include "sweep/sub_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sweep/backend.h"
#include "sweep/best_planes.h"
#include "sweep/heights.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

// Cost curves of all cells: 2 grey levels + `slope` per plane on both sides of surface(column, row).
template <typename Surface>
CostVolume curves(const SweepProblem& problem, double slope, Surface surface) {
  CostVolume costs(problem, 0);
  for (int y = 0; y < costs.height(); ++y) {
    for (int x = 0; x < costs.width(); ++x) {
      const PlaneRange planes = costs.planes_at(x, y).hull();
      for (int k = planes.first; k <= planes.last; ++k)
        costs.cell(x, y)[k - planes.first] = quantized_cost(2 + slope * std::abs(k - surface(x, y)));
    }
  }
  return costs;
}

SweepProblem problem_of(int side, int planes) {
  SweepProblem problem;
  problem.grid = {side, side, 1, {0, 0}};
  problem.search_everywhere({0, planes});
  return problem;
}

TEST(SubPlaneVertex, lies_between_that_of_a_parabola_and_that_of_a_v) {
  // (k + 0.25)^2 and |k + 0.25| at -1, 0, 1.
  const double of_parabola = sub_plane_vertex(0.5625, 0.0625, 1.5625);
  const double of_v = sub_plane_vertex(0.75, 0.25, 1.25);
  EXPECT_NEAR(of_parabola, 0.5 * (-0.25 - 0.5 / 1.5), 1e-12);
  EXPECT_NEAR(of_v, 0.5 * (-0.25 / 1.5 - 0.25), 1e-12);
  EXPECT_EQ(sub_plane_vertex(3, 1, 3), 0);
  EXPECT_NEAR(sub_plane_vertex(1, 1, 3), -0.5, 1e-12);
}

TEST(SubPlaneVertex, does_not_exist_without_an_upward_bend) {
  EXPECT_TRUE(std::isnan(sub_plane_vertex(1, 1, 1)));
  EXPECT_TRUE(std::isnan(sub_plane_vertex(0, 1, 2)));
  EXPECT_TRUE(std::isnan(sub_plane_vertex(1, 2, 1)));
}

TEST(RefineFractions, noise_of_single_cells_averages_out) {
  SweepProblem problem = problem_of(40, 12);
  Random random(5);
  Array2d<double> noise(40, 40);
  for (double& v : noise) v = 0.2 * random.normal();
  const CostVolume costs = curves(problem, 3, [&](int x, int y) { return 6 + noise(x, y); });
  SerialExecutor serial;
  const auto spread = [&](int radius) {
    MatchResult result = best_planes(costs, costs);
    problem.options.refinement_radius_cells = radius;
    refine_fractions(problem, costs, serial, result);
    double sum = 0;
    for (int y = 5; y < 35; ++y)
      for (int x = 5; x < 35; ++x) sum += std::pow(result.plane(x, y) + result.fraction(x, y) - 6, 2);
    return std::sqrt(sum / (30 * 30));
  };
  EXPECT_GT(spread(0), 0.1);
  EXPECT_LT(spread(3), 0.4 * spread(0));
}

TEST(RefineFractions, cells_beyond_a_step_do_not_count) {
  SweepProblem problem = problem_of(20, 30);
  const CostVolume costs = curves(problem, 3, [](int x, int) { return x < 10 ? 4.0 : 25.0; });
  SerialExecutor serial;
  MatchResult result = best_planes(costs, costs);
  problem.options.refinement_radius_cells = 3;
  refine_fractions(problem, costs, serial, result);
  for (int x = 0; x < 20; ++x) EXPECT_NEAR(result.plane(x, 9) + result.fraction(x, 9), x < 10 ? 4 : 25, 1e-6) << x;
}

TEST(RefineFractions, a_slope_keeps_its_heights) {
  SweepProblem problem = problem_of(30, 30);
  const CostVolume costs = curves(problem, 3, [](int x, int y) { return 5 + 0.31 * x + 0.17 * y; });
  SerialExecutor serial;
  MatchResult result = best_planes(costs, costs);
  problem.options.refinement_radius_cells = 3;
  refine_fractions(problem, costs, serial, result);
  for (int y = 5; y < 25; ++y)
    for (int x = 5; x < 25; ++x)
      EXPECT_NEAR(result.plane(x, y) + result.fraction(x, y), 5 + 0.31 * x + 0.17 * y, 0.06) << x << " " << y;
}

// Photographs of level ground between two planes, through the whole chain: the mean must not be drawn to either.
TEST(RefineFractions, level_ground_between_planes_has_no_bias) {
  SerialExecutor serial;
  for (const double fraction : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double ground = 0.12 * fraction;
    test::SyntheticProblem p =
        test::ring_of_views(6, test::small_camera(), [ground](double, double) { return ground; });
    test::set_grid(p.problem, 48, 0.1, 0.12, -0.7, 0.7);
    const Heights found = heights_from_matches(p.problem, match_planes(p.problem, Backend::cpu, serial));
    double sum = 0;
    int count = 0;
    for (const float z : found.height_m) {
      if (std::isnan(z)) continue;
      sum += z - ground;
      ++count;
    }
    ASSERT_GT(count, 2000) << fraction;
    EXPECT_LT(std::abs(sum / count), 0.12 / 20) << "at " << fraction << " of a plane step";
  }
}

}  // namespace
}  // namespace skysweep::sweep
