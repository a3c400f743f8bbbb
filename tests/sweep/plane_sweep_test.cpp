// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sweep/bands.h"
#include "sweep/heights.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }

test::SyntheticProblem rolling_ground(int views = 7) {
  test::SyntheticProblem p = test::ring_of_views(views, test::small_camera(), rolling);
  test::set_grid(p.problem, 96, 0.1, 0.1, -2.5, 2.5);
  return p;
}

double median_error(const test::SyntheticProblem& p, const SweepResult& result, const test::Surface& surface) {
  std::vector<double> errors;
  for (int y = 0; y < p.problem.grid.height; ++y) {
    for (int x = 0; x < p.problem.grid.width; ++x) {
      const Vec2d cell = p.problem.grid.cell_center(x, y);
      if (!std::isnan(result.height_m(x, y)))
        errors.push_back(std::abs(result.height_m(x, y) - surface(cell.x, cell.y)));
    }
  }
  if (errors.empty()) return 1e9;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

TEST(PlaneSweep, finds_rolling_ground_to_a_fraction_of_the_ground_sampling_distance) {
  const test::SyntheticProblem p = rolling_ground();
  SerialExecutor serial;
  const SweepResult result = plane_sweep(p.problem, Backend::cpu, serial);
  EXPECT_LT(median_error(p, result, rolling), 0.02);  // GSD 0.1 m
  std::size_t known = 0, colored = 0;
  for (std::size_t i = 0; i < result.height_m.size(); ++i) {
    known += !std::isnan(result.height_m.data()[i]);
    colored += result.color.data()[i].a == 255;
    EXPECT_EQ(std::isnan(result.height_m.data()[i]) || result.filled.data()[i], std::isnan(result.sigma_m.data()[i]));
  }
  EXPECT_GT(known, result.height_m.size() * 98 / 100);
  EXPECT_GT(colored, known * 98 / 100);
}

TEST(PlaneSweep, gives_the_same_bits_for_any_number_of_threads) {
  const test::SyntheticProblem p = rolling_ground(5);
  SerialExecutor serial;
  ThreadExecutor threads(3);
  const SweepResult a = plane_sweep(p.problem, Backend::cpu, serial), b = plane_sweep(p.problem, Backend::cpu, threads);
  for (std::size_t i = 0; i < a.height_m.size(); ++i) {
    const float ha = a.height_m.data()[i], hb = b.height_m.data()[i];
    EXPECT_TRUE(ha == hb || (std::isnan(ha) && std::isnan(hb)));
  }
  EXPECT_EQ(a.color, b.color);
}

TEST(PlaneSweep, colours_are_those_of_the_ground) {
  const test::SyntheticProblem p = rolling_ground();
  SerialExecutor serial;
  const SweepResult result = plane_sweep(p.problem, Backend::cpu, serial);
  double difference = 0, count = 0;
  for (int y = 0; y < p.problem.grid.height; ++y) {
    for (int x = 0; x < p.problem.grid.width; ++x) {
      if (result.color(x, y).a == 0) continue;
      const Vec2d cell = p.problem.grid.cell_center(x, y);
      difference += std::abs(result.color(x, y).g - test::ground_texture(cell.x, cell.y));
      ++count;
    }
  }
  EXPECT_LT(difference / count, 3);
}

TEST(PlaneSweep, knows_nothing_where_fewer_than_two_photographs_look) {
  test::SyntheticProblem p = rolling_ground(3);
  for (View& view : p.problem.views)
    view.camera = camera::Camera(view.camera.model(),
                                 {view.camera.pose().cam_from_world, view.camera.pose().center + Vec3d{400, 0, 0}});
  SerialExecutor serial;
  const SweepResult result = plane_sweep(p.problem, Backend::cpu, serial);
  for (const float z : result.height_m) EXPECT_TRUE(std::isnan(z));
  for (const Rgba8 c : result.color) EXPECT_EQ(c.a, 0);
}

TEST(PlaneSweep, colours_the_core_as_it_would_without_a_collar_and_the_collar_not_at_all) {
  test::SyntheticProblem p = rolling_ground(5);
  SerialExecutor serial;
  const SweepResult whole = plane_sweep(p.problem, Backend::cpu, serial);
  p.problem.collar_cells = 16;
  const SweepResult core = plane_sweep(p.problem, Backend::cpu, serial);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const bool in_core = std::min(x, y) >= 16 && std::max(x, y) < 96 - 16;
      EXPECT_EQ(core.color(x, y), in_core ? whole.color(x, y) : Rgba8{}) << x << ", " << y;
      EXPECT_EQ(core.view_count(x, y), in_core ? whole.view_count(x, y) : 0) << x << ", " << y;
      EXPECT_EQ(std::isnan(core.height_m(x, y)), std::isnan(whole.height_m(x, y)));
    }
  }
}

TEST(PlaneSweep, planar_fallback_colours_cells_without_height_only_when_asked) {
  test::SyntheticProblem p = rolling_ground(5);
  p.problem.block_planes(5, 0) = {};
  SerialExecutor serial;
  EXPECT_EQ(plane_sweep(p.problem, Backend::cpu, serial).color(80, 5).a, 0);
  p.problem.options.planar_fallback = true;
  const SweepResult result = plane_sweep(p.problem, Backend::cpu, serial);
  EXPECT_EQ(result.color(80, 5).a, 255);
  EXPECT_EQ(result.planar(80, 5), 1);
  EXPECT_TRUE(std::isnan(result.height_m(80, 5)));
  EXPECT_EQ(result.planar(20, 20), 0);
}

TEST(PlaneSweep, in_bands_finds_nearly_the_same_heights_within_the_memory_it_is_given) {
  test::SyntheticProblem p = test::ring_of_views(5, test::small_camera(), rolling);
  test::set_grid(p.problem, 256, 0.08, 0.1, -2.5, 2.5);
  SerialExecutor serial;
  const Heights whole = heights_from_matches(p.problem, match_planes(p.problem, Backend::cpu, serial));
  p.problem.options.volume_limit_mib = 14;  // of 16
  EXPECT_EQ(bands_within(p.problem).size(), 2u);
  const Heights bands = heights_from_matches(p.problem, match_planes(p.problem, Backend::cpu, serial));
  int different = 0;
  for (std::size_t i = 0; i < whole.height_m.size(); ++i)
    different += std::abs(whole.height_m.data()[i] - bands.height_m.data()[i]) > 0.5 * p.problem.dz_m;
  EXPECT_LE(different, 256 * 256 / 200);
}

// Every option changes the result: none is dead.
TEST(SweepOptions, each_changes_the_result) {
  const test::SyntheticProblem usual = rolling_ground(5);
  SerialExecutor serial;
  const MatchResult expected = match_planes(usual.problem, Backend::cpu, serial);
  const Heights heights = heights_from_matches(usual.problem, expected);
  const auto differs = [&](auto change) {
    SweepProblem problem = usual.problem;
    change(problem.options);
    const Heights other = heights_from_matches(problem, match_planes(problem, Backend::cpu, serial));
    for (std::size_t i = 0; i < heights.height_m.size(); ++i) {
      const float a = heights.height_m.data()[i], b = other.height_m.data()[i];
      if (!(a == b || (std::isnan(a) && std::isnan(b)))) return true;
    }
    return false;
  };
  EXPECT_FALSE(differs([](SweepOptions&) {}));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.refinement_radius_cells = 0; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.window_level_min = 1; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.window_level_max = 2; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.aggregation = Aggregation::all_views; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.aggregation = Aggregation::better_half; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.smoothing = Smoothing::none; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.small_step_penalty = 0.1; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.large_step_penalty = 1; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.min_views = 5; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.few_views_penalty = 60; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.max_cost = 1; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.max_cost_to_mean = 0.1; }));
}

}  // namespace
}  // namespace skysweep::sweep
