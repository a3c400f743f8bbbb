// SPDX-License-Identifier: Apache-2.0
#include "sweep/patch_costs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sweep/backend.h"
#include "sweep/heights.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

double flat(double, double) { return 0; }

// Four straight views of flat ground, small; two of them seen through a longer exposure: luminance a Y + b.
test::SyntheticProblem two_exposures(double factor, int offset) {
  test::SyntheticProblem p;
  for (int v = 0; v < 4; ++v) {
    const camera::Camera camera(test::small_camera(150, 100, 80),
                                {camera::rotation_from_yaw_pitch_roll(90 * v, -90, 0), {2.0 * v - 3, v % 2 - 0.5, 15}});
    Array2d<Rgb8> photograph = test::photograph_of(camera, flat);
    for (Rgb8& c : photograph) {
      const double grey = v % 2 ? factor * c.g + offset : c.g;
      c = {static_cast<std::uint8_t>(grey), static_cast<std::uint8_t>(grey), static_cast<std::uint8_t>(grey)};
    }
    p.images.emplace_back(std::move(photograph));
    p.problem.views.push_back({&p.images.back(), camera, 0});
  }
  test::set_grid(p.problem, 24, 0.15, 0.1, -1, 1);
  p.problem.options.normalization_radius_px = 0;
  p.problem.options.coarse_levels = 0;
  p.problem.options.smoothing = Smoothing::none;
  p.problem.options.max_cost_to_mean = 1;
  return p;
}

// Share of cells within half a plane of the ground, 0.
double share_right(test::SyntheticProblem& p, MatchingCost cost) {
  p.problem.options.cost = cost;
  SerialExecutor serial;
  const MatchResult matches = match_planes(p.problem, Backend::cpu, serial);
  int right = 0;
  for (const int plane : matches.plane) right += plane == 0;
  return static_cast<double>(right) / static_cast<double>(matches.plane.size());
}

TEST(PatchCosts, patches_match_where_exposures_differ_and_luminance_does_not) {
  test::SyntheticProblem p = two_exposures(0.6, 20);
  p.problem.options.aggregation = Aggregation::all_views;
  EXPECT_GT(share_right(p, MatchingCost::zncc), 0.97);
  EXPECT_GT(share_right(p, MatchingCost::census), 0.9);
  EXPECT_LT(share_right(p, MatchingCost::sad), 0.6);
}

// The sums without pairs are the sums over pairs.
TEST(PatchCosts, of_two_views_zncc_is_one_minus_the_correlation) {
  test::SyntheticProblem p = two_exposures(0.8, 10);
  p.problem.views.erase(p.problem.views.begin() + 2, p.problem.views.end());
  p.problem.options.cost = MatchingCost::zncc;
  p.problem.options.window_level_max = 0;
  p.problem.options.few_views_penalty = 0;
  const Vec3d point{0.3, -0.2, 0.4};
  const ViewSamples samples = views_showing(p.problem, point);
  ASSERT_EQ(samples.count, 2);
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) {
      const Vec3d at{point.x + 0.15 * dx, point.y + 0.15 * dy, point.z};
      const View &first = p.problem.views[0], &second = p.problem.views[1];
      const double x = first.image->sample_luminance(*first.camera.project(at), 0);
      const double y = second.image->sample_luminance(*second.camera.project(at), 0);
      a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
    }
  const double correlation = (ab - a * b / 25) / std::sqrt((aa - a * a / 25) * (bb - b * b / 25));
  EXPECT_NEAR(patch_cost(p.problem, point, samples) / kPatchCostGrey, 1 - correlation, 0.02);
}

TEST(PatchCosts, of_all_views_is_the_mean_over_the_pairs) {
  test::SyntheticProblem p = two_exposures(0.8, 10);
  SweepOptions& options = p.problem.options;
  options.few_views_penalty = 0;
  options.window_level_max = 1;
  const Vec3d point{0.1, 0.2, 0.3};
  for (const MatchingCost cost : {MatchingCost::zncc, MatchingCost::census}) {
    options.cost = cost;
    options.aggregation = Aggregation::all_views;
    const ViewSamples all = views_showing(p.problem, point);
    ASSERT_EQ(all.count, 4);
    double pairs = 0;
    for (int i = 0; i < 4; ++i)
      for (int k = i + 1; k < 4; ++k) {
        ViewSamples two = all;
        two.count = 2;
        two.view[0] = all.view[i], two.view[1] = all.view[k];
        pairs += patch_cost(p.problem, point, two) / 6;
      }
    EXPECT_NEAR(patch_cost(p.problem, point, all), pairs, 1e-9);
    options.aggregation = Aggregation::consensus;
    options.consensus_share = 1;
    EXPECT_NEAR(patch_cost(p.problem, point, all), pairs, 1e-9);
  }
}

TEST(PatchCosts, each_of_their_options_changes_the_cost) {
  test::SyntheticProblem p = two_exposures(0.8, 10);
  const Vec3d point{0.1, 0.2, 0.3};
  const auto cost_with = [&](auto change) {
    SweepProblem problem = p.problem;
    problem.options.cost = MatchingCost::zncc;
    change(problem.options);
    ViewSamples samples = views_showing(problem, point);
    keep_showing_patch(problem, point, samples);
    return patch_cost(problem, point, samples);
  };
  const double usual = cost_with([](SweepOptions&) {});
  EXPECT_NE(usual, cost_with([](SweepOptions& o) { o.cost = MatchingCost::census; }));
  EXPECT_NE(usual, cost_with([](SweepOptions& o) { o.patch_radius_cells = 1; }));
  EXPECT_NE(usual, cost_with([](SweepOptions& o) { o.window_level_max = 0; }));
  EXPECT_NE(usual, cost_with([](SweepOptions& o) { o.min_views = 5; }));
}

TEST(PatchCosts, wrong_settings_are_refused_with_a_sentence) {
  SweepOptions options;
  for (const int radius : {0, 3}) {
    options.patch_radius_cells = radius;
    EXPECT_EQ(options.problem().value_or(""), "patch_radius_cells must be 1 or 2");
  }
  options.patch_radius_cells = 2;
  options.window_level_max = 3;
  EXPECT_FALSE(options.problem());
  options.cost = MatchingCost::census;
  EXPECT_EQ(options.problem().value_or(""),
            "patch_radius_cells * 2^window_level_max must not exceed 8 with cost = \"zncc\" or \"census\"");
}

}  // namespace
}  // namespace skysweep::sweep
