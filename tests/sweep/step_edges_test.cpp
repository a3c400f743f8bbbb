// SPDX-License-Identifier: Apache-2.0
#include "sweep/step_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "hard/box_world.h"
#include "sweep/plane_sweep.h"

namespace skysweep::sweep {
namespace {

constexpr int kCells = 64;
constexpr double kCell = 0.1, kRoof = 4;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// A house on level ground: 64 x 64 cells of 0.1 m, eight photographs with pixels as large. The ground is darker than
// the roof, the walls lie between.
struct House : hard::WorldProblem {
  House() : WorldProblem(hard::BoxWorld{.boxes = {{{-1.4, -1.2, 0}, {1.6, 1.8, kRoof}}}}) {
    add_ring(8, test::small_camera(), 6, 30, [this](Vec3d p) {
      return world.grey(p) * 0.6 + (p.z > kRoof - 0.01 ? 40 : p.z > 0.01 ? 20 : 0);
    });
    set_grid(kCells, kCell, 0.1, -1, 6);
  }
  float truth(int column, int row) const {
    const Vec2d cell = problem.grid.cell_center(column, row);
    return static_cast<float>(world.top(cell.x, cell.y));
  }
  // What is known for certain, but for the roof, which reaches `farther` cells over the ground on every side.
  Heights heights(int farther) const {
    Heights out{Array2d<float>(kCells, kCells, 0.0f), Array2d<float>(kCells, kCells, 0.01f)};
    for (int row = 0; row < kCells; ++row)
      for (int column = 0; column < kCells; ++column) {
        const Vec2d cell = problem.grid.cell_center(column, row);
        const double b = farther * kCell;
        const bool roof = cell.x > -1.4 - b && cell.x < 1.6 + b && cell.y > -1.2 - b && cell.y < 1.8 + b;
        out.height_m(column, row) = roof ? static_cast<float>(kRoof) : 0.0f;
      }
    return out;
  }
  int wrong(const Heights& heights) const {
    int count = 0;
    for (int row = 0; row < kCells; ++row)
      for (int column = 0; column < kCells; ++column)
        count += !(std::abs(heights.height_m(column, row) - truth(column, row)) < 0.2);
    return count;
  }
};

const House& house() {
  static const House town;
  return town;
}

Heights settled(Heights heights, const SweepOptions& options = {}) {
  SweepProblem problem = house().problem;
  problem.options = options;
  SerialExecutor serial;
  settle_edges(problem, serial, heights);
  return heights;
}

TEST(StepEdges, a_roof_that_reaches_too_far_or_not_far_enough_ends_at_its_walls) {
  for (const int farther : {-2, -1, 1, 2}) {
    const Heights before = house().heights(farther);
    ASSERT_GE(house().wrong(before), 100) << farther;
    EXPECT_LE(house().wrong(settled(before)), 20) << farther;  // of 120 cells along the walls
  }
}

TEST(StepEdges, each_pass_reaches_as_far_as_it_is_asked_to) {
  const Heights before = house().heights(4);
  const auto wrong = [&](int passes, int reach) {
    SweepOptions options;
    options.edge_passes = passes, options.edge_reach_cells = reach;
    return house().wrong(settled(before, options));
  };
  const int untouched = house().wrong(before);
  EXPECT_EQ(wrong(0, 2), untouched);
  EXPECT_LT(wrong(1, 2), 0.7 * untouched);
  EXPECT_LT(wrong(3, 2), 0.5 * wrong(1, 2));
  EXPECT_LT(wrong(1, 5), 0.5 * wrong(1, 2));
}

TEST(StepEdges, of_the_right_edges_hardly_any_moves_and_nothing_away_from_them) {
  const Heights before = house().heights(0), after = settled(before);
  EXPECT_LE(house().wrong(after), 20);
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      const Vec2d cell = house().problem.grid.cell_center(column, row);
      const double outside = std::max(std::max(-1.4 - cell.x, cell.x - 1.6), std::max(-1.2 - cell.y, cell.y - 1.8));
      if (std::abs(outside) < 0.6) continue;
      EXPECT_EQ(after.height_m(column, row), before.height_m(column, row)) << column << ", " << row;
      EXPECT_EQ(after.sigma_m(column, row), before.sigma_m(column, row)) << column << ", " << row;
    }
}

TEST(StepEdges, a_gap_at_a_step_takes_the_surface_that_is_seen_there) {
  Heights heights = house().heights(0);
  int gaps = 0;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      const Vec2d cell = house().problem.grid.cell_center(column, row);
      if (std::abs(cell.x - 1.6) > 0.16 || std::abs(cell.y) > 1) continue;
      heights.height_m(column, row) = heights.sigma_m(column, row) = kNone;
      ++gaps;
    }
  ASSERT_GE(gaps, 80);
  const Heights after = settled(heights);
  EXPECT_LE(house().wrong(after), 40);
}

TEST(StepEdges, what_too_few_views_see_stays_a_gap) {
  House world;
  world.problem.views.erase(world.problem.views.begin() + 1, world.problem.views.end());
  Heights heights = world.heights(0);
  for (int row = 20; row < 40; ++row) heights.height_m(47, row) = heights.sigma_m(47, row) = kNone;
  SerialExecutor serial;
  settle_edges(world.problem, serial, heights);
  for (int row = 20; row < 40; ++row) EXPECT_TRUE(std::isnan(heights.height_m(47, row))) << row;
}

TEST(StepEdges, what_views_see_differently_at_every_height_stays_a_gap) {
  Heights heights = house().heights(0);
  for (int row = 0; row < 13; ++row)
    for (int column = 8; column < 24; ++column)  // open ground, and on both sides of the gap heights that are wrong
      heights.height_m(column, row) = column == 15 || column == 16 ? kNone : column < 14 ? 2.0f : 1.0f;
  SweepOptions options;
  options.edge_passes = 1;  // the next would bring the ground in
  const Heights after = settled(heights, options);
  int gaps = 0, open = 0;
  for (int row = 0; row < 9; ++row)
    for (int column = 15; column < 17; ++column) ++gaps, open += std::isnan(after.height_m(column, row));
  EXPECT_GE(open, gaps / 2) << "of " << gaps;
}

TEST(StepEdges, a_roof_that_slopes_goes_on_sloping_to_its_edge) {
  const House world;
  Heights heights = world.heights(0);
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column)
      if (heights.height_m(column, row) > 1) heights.height_m(column, row) = 4 + 0.05f * static_cast<float>(row - 32);
  const Heights before = heights;
  SweepProblem problem = world.problem;
  problem.options.edge_passes = 1, problem.options.edge_reach_cells = 1;
  problem.options.edge_hidden_cost = 40;  // what nothing hides is best: the roof grows by a cell or two on every side
  SerialExecutor serial;
  settle_edges(problem, serial, heights);
  int grown = 0;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column)
      if (before.height_m(column, row) == 0 && heights.height_m(column, row) > 1) {
        ++grown;
        EXPECT_NEAR(heights.height_m(column, row), 4 + 0.05 * (row - 32), 0.05) << column << ", " << row;
      }
  EXPECT_GE(grown, 10);
}

TEST(StepEdges, among_nothing_but_steps_none_is_an_edge) {
  Heights crowns = house().heights(0);
  Random random(3);
  for (float& z : crowns.height_m) z = static_cast<float>(random.uniform(0, 6));
  const Heights before = crowns;
  EXPECT_EQ(settled(crowns).height_m, before.height_m);
}

TEST(StepEdges, the_penalty_takes_single_cells_and_the_hidden_cost_decides_for_the_roof_or_the_ground) {
  const Heights before = house().heights(1);
  const auto roof_cells = [&](auto change) {
    SweepOptions options;
    change(options);
    const Heights after = settled(before, options);
    int roof = 0, edges = 0;
    for (int row = 1; row < kCells; ++row)
      for (int column = 1; column < kCells; ++column) {
        const bool high = after.height_m(column, row) > 2;
        roof += high;
        edges += high != (after.height_m(column - 1, row) > 2);
        edges += high != (after.height_m(column, row - 1) > 2);
      }
    return std::pair(roof, edges);
  };
  const auto usual = roof_cells([](SweepOptions&) {});
  EXPECT_GT(roof_cells([](SweepOptions& o) { o.edge_hidden_cost = 25; }).first, usual.first);
  EXPECT_LT(roof_cells([](SweepOptions& o) { o.edge_hidden_cost = 0; }).first, usual.first);
  EXPECT_GT(roof_cells([](SweepOptions& o) { o.edge_penalty = 0; }).second, usual.second);
}

TEST(StepEdges, do_not_depend_on_the_number_of_threads) {
  Heights one = house().heights(2), three = one;
  SerialExecutor serial;
  ThreadExecutor threads(3);
  settle_edges(house().problem, serial, one);
  settle_edges(house().problem, threads, three);
  EXPECT_EQ(one.height_m, three.height_m);
  EXPECT_EQ(one.sigma_m, three.sigma_m);
}

TEST(StepEdges, wrong_options_are_refused_with_a_sentence) {
  const auto sentence = [](auto change) {
    SweepOptions options;
    change(options);
    return options.problem().value_or("");
  };
  EXPECT_EQ(sentence([](SweepOptions& o) { o.edge_passes = 9; }), "edge_passes must lie between 0 (off) and 8");
  EXPECT_EQ(sentence([](SweepOptions& o) { o.edge_reach_cells = 0; }), "edge_reach_cells must lie between 1 and 16");
  EXPECT_EQ(sentence([](SweepOptions& o) { o.edge_penalty = -1; }), "edge_penalty must lie between 0 and 255");
  EXPECT_EQ(sentence([](SweepOptions& o) { o.edge_hidden_cost = 300; }), "edge_hidden_cost must lie between 0 and 255");
}

}  // namespace
}  // namespace skysweep::sweep
