// SPDX-License-Identifier: Apache-2.0
#include "sweep/luminance_gains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sweep/backend.h"
#include "sweep/height_range.h"
#include "sweep/linear_light.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

double rolling(double x, double y) { return 0.5 * std::sin(x / 3) + 0.3 * std::cos(y / 4); }

// Five views of rolling ground; light of every other one `factor` times as strong, of the rest as much weaker.
// The classic search: sums of absolute differences of luminance as photographed, each cell by itself.
test::SyntheticProblem two_exposures(double factor) {
  static const test::SyntheticProblem plain = test::ring_of_views(5, test::small_camera(150, 140, 110), rolling);
  test::SyntheticProblem p;
  for (int v = 0; v < 5; ++v) {
    const camera::Camera& camera = plain.problem.views[v].camera;
    Array2d<Rgb8> photograph(camera.model().width_px, camera.model().height_px);
    for (int y = 0; y < photograph.height(); ++y)
      for (int x = 0; x < photograph.width(); ++x) {
        const int grey = static_cast<int>(std::lround(plain.images[v].luminance(0).at(x, y) / kLuminanceScale));
        const float light = linear_light(static_cast<std::uint8_t>(grey));
        const std::uint8_t c = encoded_light(light * static_cast<float>(v % 2 ? factor : 1 / factor));
        photograph(x, y) = {c, c, c};
      }
    p.images.emplace_back(std::move(photograph));
    p.problem.views.push_back({&p.images.back(), camera, 0});
  }
  test::set_grid(p.problem, 64, 0.2, 0.2, -2, 2);
  SweepOptions& options = p.problem.options;
  options.normalization_radius_px = 0;
  options.coarse_levels = 0;
  options.window_level_max = 2;
  options.aggregation = Aggregation::all_views;
  options.smoothing = Smoothing::none;
  return p;
}

Array2d<float> ground_level(const SweepProblem& problem) {
  const int cells = (problem.grid.width + kCoarseCells - 1) / kCoarseCells;
  return Array2d<float>(cells, cells, 0.0f);
}

double share_right(const SweepProblem& problem) {
  SerialExecutor serial;
  const MatchResult matches = match_planes(problem, Backend::cpu, serial);
  int right = 0;
  for (int y = 0; y < problem.grid.height; ++y)
    for (int x = 0; x < problem.grid.width; ++x) {
      const Vec2d cell = problem.grid.cell_center(x, y);
      right += std::abs(matches.plane(x, y) * problem.dz_m - rolling(cell.x, cell.y)) <= problem.dz_m;
    }
  return static_cast<double>(right) / static_cast<double>(matches.plane.size());
}

TEST(LuminanceGains, the_classic_cost_bears_exposures_that_differ_by_fifteen_percent) {
  SerialExecutor serial;
  test::SyntheticProblem equal = two_exposures(1), different = two_exposures(1.15);
  const double at_best = share_right(equal.problem), uncompensated = share_right(different.problem);
  equalize_luminance(ground_level(different.problem), serial, different.problem);
  const double compensated = share_right(different.problem);
  RecordProperty("equal_uncompensated_compensated",
                 std::to_string(at_best) + " " + std::to_string(uncompensated) + " " + std::to_string(compensated));
  EXPECT_GT(compensated, at_best - 0.02);
  EXPECT_LT(uncompensated, at_best - 0.1);
}

TEST(LuminanceGains, are_those_of_the_photographs) {
  SerialExecutor serial;
  test::SyntheticProblem p = two_exposures(1.15);
  equalize_luminance(ground_level(p.problem), serial, p.problem);
  const std::vector<View>& views = p.problem.views;
  EXPECT_NEAR(views[0].gain / views[1].gain, std::pow(1.15 * 1.15, 1 / 2.4), 0.01);
  EXPECT_NEAR(views[0].gain / views[2].gain, 1, 0.01);
  EXPECT_NEAR(views[0].offset, 14.0 * (views[0].gain - 1), 0.01);
}

TEST(LuminanceGains, equal_exposures_change_nothing) {
  SerialExecutor serial;
  test::SyntheticProblem p = two_exposures(1);
  equalize_luminance(ground_level(p.problem), serial, p.problem);
  for (const View& view : p.problem.views) {
    EXPECT_EQ(view.gain, 1);
    EXPECT_EQ(view.offset, 0);
  }
}

TEST(LuminanceGains, only_where_luminance_is_compared_as_photographed) {
  SerialExecutor serial;
  const auto touched = [&](auto change) {
    test::SyntheticProblem p = two_exposures(1.15);
    change(p.problem.options);
    equalize_luminance(ground_level(p.problem), serial, p.problem);
    return p.problem.views[0].gain != 1;
  };
  EXPECT_TRUE(touched([](SweepOptions&) {}));
  EXPECT_FALSE(touched([](SweepOptions& o) { o.normalization_radius_px = 2; }));
  EXPECT_FALSE(touched([](SweepOptions& o) { o.cost = MatchingCost::zncc; }));
  EXPECT_FALSE(touched([](SweepOptions& o) { o.compensate_exposure = false; }));
}

}  // namespace
}  // namespace skysweep::sweep
