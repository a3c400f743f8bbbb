// SPDX-License-Identifier: Apache-2.0
#include "sweep/expected_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {

constexpr int kCells = 24;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

SweepProblem problem_of(int cells) {
  SweepProblem problem;
  problem.grid = {cells, cells, 1, {0, 0}};
  return problem;
}

// What a search would find of surface(x, y), in planes; x and y count cells from the centre of cell (0, 0).
template <typename Surface>
MatchResult found(Surface surface) {
  MatchResult result(kCells, kCells);
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const double z = surface(x, y);
      result.plane(x, y) = static_cast<int>(std::lround(z));
      result.fraction(x, y) = static_cast<float>(z - result.plane(x, y));
      result.cost(x, y) = 1;
      result.rival_excess(x, y) = kInfinity;
    }
  }
  return result;
}

double slope(double x, double y) { return 5 + 0.7 * x - 0.45 * y; }

TEST(ExpectedPlanes, a_slope_is_given_back_as_it_is) {
  const Array2d<float> expected = expected_planes(found(slope), 1, problem_of(kCells));
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) EXPECT_NEAR(expected(x, y), slope(x, y), 1e-4) << x << ", " << y;
}

TEST(ExpectedPlanes, on_cells_half_as_large_the_slope_goes_on_within_each_coarse_cell) {
  // The last row and column of an odd grid are half coarse cells.
  const Array2d<float> expected = expected_planes(found(slope), 2, problem_of(2 * kCells - 1));
  for (int y = 0; y < expected.height(); ++y)
    for (int x = 0; x < expected.width(); ++x)
      EXPECT_NEAR(expected(x, y), 2 * slope(0.5 * x - 0.25, 0.5 * y - 0.25), 2e-4) << x << ", " << y;
}

TEST(ExpectedPlanes, cells_that_are_not_sure_expect_nothing_and_do_not_count) {
  MatchResult matches = found(slope);
  SweepProblem problem = problem_of(kCells);
  problem.options.sure_excess = 5;
  matches.rival_excess(10, 10) = 2.4f;  // less than half of what makes sure
  matches.plane(10, 10) += 1;           // and wrong
  matches.rival_excess(3, 3) = 2.6f;
  matches.fraction(17, 5) = std::numeric_limits<float>::quiet_NaN();
  const Array2d<float> expected = expected_planes(matches, 1, problem);
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      if ((x == 10 && y == 10) || (x == 17 && y == 5))
        EXPECT_TRUE(std::isnan(expected(x, y))) << x << ", " << y;
      else
        EXPECT_NEAR(expected(x, y), slope(x, y), 1e-4) << x << ", " << y;
    }
  }
}

TEST(ExpectedPlanes, how_sure_is_a_setting) {
  MatchResult matches = found(slope);
  SweepProblem problem = problem_of(kCells);
  for (float& excess : matches.rival_excess) excess = 3;
  const auto expects = [&](double sure_excess) {
    problem.options.sure_excess = sure_excess;
    return !std::isnan(expected_planes(matches, 1, problem)(8, 8));
  };
  EXPECT_TRUE(expects(5));
  EXPECT_FALSE(expects(7));
}

TEST(ExpectedPlanes, a_step_is_not_smeared) {
  const auto step = [](double x, double) { return x < 12 ? 4.25 : 24.25; };
  const Array2d<float> expected = expected_planes(found(step), 1, problem_of(kCells));
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) EXPECT_NEAR(expected(x, y), step(x, y), 1e-5) << x << ", " << y;
}

TEST(ExpectedPlanes, noise_averages_out) {
  MatchResult matches = found([](double, double) { return 7; });
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) matches.fraction(x, y) = (x + y) % 2 ? 0.4f : -0.4f;
  const Array2d<float> expected = expected_planes(matches, 1, problem_of(kCells));
  for (int y = 2; y < kCells - 2; ++y)
    for (int x = 2; x < kCells - 2; ++x) EXPECT_NEAR(expected(x, y), 7, 0.04) << x << ", " << y;
}

}  // namespace
}  // namespace skysweep::sweep
