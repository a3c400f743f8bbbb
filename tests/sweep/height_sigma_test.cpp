// SPDX-License-Identifier: Apache-2.0
#include "sweep/height_sigma.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/plane_sweep.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

constexpr float kUnit = 0.06f, kPlaneStep = 0.04f;

// One cell of smooth, textured ground, of which the costs are sure.
SigmaSigns sure_signs() {
  const auto cell = [](float v) { return Array2d<float>(1, 1, v); };
  return {cell(kUnit), cell(0.01f), cell(0.03f), cell(0.002f), cell(14), cell(14),
          cell(0),     cell(3),     cell(3),     cell(3),      {}};
}

double sigma_with(const SigmaSigns& signs, double dz_m = kPlaneStep) {
  return height_sigma(Array2d<float>(1, 1, 100), signs, dz_m)(0, 0);
}

TEST(HeightSigma, is_a_tenth_of_a_pixel_where_all_is_well) {
  const double in_pixels = sigma_with(sure_signs()) / kUnit;
  EXPECT_GT(in_pixels, 0.04);
  EXPECT_LT(in_pixels, 0.2);
}

TEST(HeightSigma, grows_with_what_speaks_against_a_height) {
  const double sure = sigma_with(sure_signs());
  const auto changed = [](auto change) {
    SigmaSigns signs = sure_signs();
    change(signs);
    return sigma_with(signs);
  };
  EXPECT_GT(changed([](SigmaSigns& s) { s.height_per_pixel_m(0, 0) *= 2; }), sure) << "weak rays";
  EXPECT_GT(changed([](SigmaSigns& s) { s.step_5_m(0, 0) = 0.1f; }), sure) << "a step";
  EXPECT_GT(changed([](SigmaSigns& s) { s.offset_m(0, 0) = 0.03f; }), sure) << "a bump";
  EXPECT_GT(changed([](SigmaSigns& s) { s.excess_9(0, 0) = 7; }), sure) << "near rivals";
  EXPECT_GT(changed([](SigmaSigns& s) { s.bend_9(0, 0) = 1; }), sure) << "a flat cost curve";
}

TEST(HeightSigma, is_of_the_size_of_the_steps_around_where_the_costs_cannot_decide) {
  SigmaSigns signs = sure_signs();
  signs.step_5_m(0, 0) = signs.step_17_m(0, 0) = 6;
  EXPECT_LT(sigma_with(signs), 1) << "sure, at the edge of a roof";
  signs.excess_3(0, 0) = 0.5f;
  EXPECT_GT(sigma_with(signs), 1);
  EXPECT_LT(sigma_with(signs), 6);
}

TEST(HeightSigma, at_a_step_is_what_the_colours_say) {
  SigmaSigns signs = sure_signs();
  signs.step_5_m(0, 0) = signs.step_17_m(0, 0) = 6;
  signs.excess_3(0, 0) = 0.5f;  // windows across the step cannot decide
  const auto with = [&](float margin, float difference) {
    signs.edges = {Array2d<float>(1, 1, margin), Array2d<float>(1, 1, difference)};
    return sigma_with(signs);
  };
  EXPECT_LT(with(3, 1), 0.5 * kUnit) << "a clear choice";
  EXPECT_GT(with(-0.5f, 1), 1) << "other surfaces would do as well";
  EXPECT_GT(with(0.8f, 4), 1) << "the views do not agree";
  const double without_choice = with(std::numeric_limits<float>::quiet_NaN(), 1);
  signs.edges = {};
  EXPECT_EQ(without_choice, sigma_with(signs));
}

TEST(HeightSigma, knows_no_scale) {
  SigmaSigns signs = sure_signs();
  const double before = sigma_with(signs);
  for (Array2d<float>* metres : {&signs.height_per_pixel_m, &signs.step_5_m, &signs.step_17_m, &signs.offset_m})
    (*metres)(0, 0) *= 1024;
  EXPECT_EQ(sigma_with(signs, 1024 * kPlaneStep), 1024 * before);
}

TEST(HeightSigma, stays_a_positive_number_where_signs_are_extreme) {
  SigmaSigns signs = sure_signs();
  signs.height_per_pixel_m(0, 0) = std::numeric_limits<float>::quiet_NaN();
  for (Array2d<float>* none : {&signs.step_5_m, &signs.step_17_m, &signs.offset_m, &signs.excess_3, &signs.excess_9,
                               &signs.bend_9, &signs.cost_9, &signs.cost_17})
    (*none)(0, 0) = 0;
  EXPECT_GT(sigma_with(signs), 0);
  EXPECT_TRUE(std::isfinite(sigma_with(signs)));
  const Array2d<float> nothing(1, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(std::isnan(height_sigma(nothing, sure_signs(), kPlaneStep)(0, 0)));
}

TEST(HeightSigma, covers_the_errors_of_ideal_photographs) {
  const auto surface = [](double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); };
  test::SyntheticProblem p = test::ring_of_views(7, test::small_camera(), surface);
  test::set_grid(p.problem, 64, 0.1, 0.1, -2.5, 2.5);
  SerialExecutor serial;
  const SweepResult result = plane_sweep(p.problem, Backend::cpu, serial);
  double known = 0, within_1 = 0, within_2 = 0, sum = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (std::isnan(result.sigma_m(x, y))) continue;
      const Vec2d cell = p.problem.grid.cell_center(x, y);
      const double error = std::abs(result.height_m(x, y) - surface(cell.x, cell.y));
      known += 1, sum += result.sigma_m(x, y), within_1 += error <= result.sigma_m(x, y),
          within_2 += error <= 1.96 * result.sigma_m(x, y);
    }
  }
  EXPECT_GT(known, 4000);
  EXPECT_GT(within_1 / known, 0.63);
  EXPECT_GT(within_2 / known, 0.92);
  EXPECT_LT(sum / known, 0.1) << "one GSD";
}

TEST(HeightSigma, doubts_everything_without_smoothing_for_nobody_looked_for_rivals) {
  SweepProblem problem;
  problem.grid = {8, 8, 0.1, {0, 0}};
  problem.search_everywhere({-5, 5});
  MatchResult matches(8, 8);
  for (float& cost : matches.cost) cost = 2;
  for (float& bend : matches.bend) bend = 3;
  const Array2d<float> level(8, 8, 0);
  EXPECT_EQ(sigma_signs(problem, matches, level).excess_3(4, 4), kLargestExcess) << "no rival: sure";
  problem.options.smoothing = Smoothing::none;
  const SigmaSigns signs = sigma_signs(problem, matches, level);
  EXPECT_EQ(signs.excess_3(4, 4), 0);
  EXPECT_EQ(signs.undecided(4, 4), 1);
}

}  // namespace
}  // namespace skysweep::sweep
