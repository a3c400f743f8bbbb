// SPDX-License-Identifier: Apache-2.0
#include "sweep/coarse_to_fine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hard/box_world.h"
#include "sweep/best_planes.h"
#include "sweep/heights.h"
#include "sweep/plane_sweep.h"
#include "sweep/smoothing.h"

namespace skysweep::sweep {
namespace {

constexpr double kPlane = 0.1, kBoxTop = 6;

// Ground at 0 with boxes, 96 x 96 cells of 0.1 m, 101 planes; 8 photographs with pixels as large.
struct Town : hard::WorldProblem {
  explicit Town(const std::vector<hard::Box>& boxes) : WorldProblem(hard::BoxWorld{.boxes = boxes}) {
    add_ring(8, test::small_camera(), 6, 30);
    set_grid(96, 0.1, kPlane, -2, 8);
  }
  int true_plane(int column, int row) const {
    const Vec2d cell = problem.grid.cell_center(column, row);
    return static_cast<int>(std::lround(world.top(cell.x, cell.y) / kPlane));
  }
};

// One house, photographed once for all tests.
const Town& house() {
  static const Town town(std::vector<hard::Box>{{{-1.55, -1.25, 0}, {1.85, 2.15, kBoxTop}}});
  return town;
}

NarrowedSearch narrowed(const SweepProblem& problem, double* samples = nullptr) {
  SerialExecutor serial;
  double taken = 0;
  NarrowedSearch search = narrow_search(problem, Backend::cpu, serial, taken);
  if (samples != nullptr) *samples = taken + sample_count(search.problem);
  return search;
}

Heights heights_of(const SweepProblem& problem) {
  SerialExecutor serial;
  return heights_from_matches(problem, search(problem, Backend::cpu, serial).matches);
}

bool same(const Array2d<float>& a, const Array2d<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a.data()[i] != b.data()[i] && !(std::isnan(a.data()[i]) && std::isnan(b.data()[i]))) return false;
  return true;
}

TEST(CoarseToFine, keeps_the_true_plane_of_nearly_every_cell) {
  const Town& town = house();
  const SweepProblem fine = narrowed(town.problem).problem;
  int kept = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) kept += fine.planes_at(x, y).contains(town.true_plane(x, y));
  EXPECT_GE(kept, 96 * 96 * 995 / 1000);
}

TEST(CoarseToFine, takes_several_times_fewer_samples_than_a_search_everywhere) {
  double samples = 0;
  narrowed(house().problem, &samples);
  const double ratio = sample_count(house().problem) / samples;
  RecordProperty("times_fewer_samples", std::to_string(ratio));
  EXPECT_GT(ratio, 2.5);
}

TEST(CoarseToFine, never_searches_a_plane_that_was_not_asked_for) {
  SweepProblem problem = house().problem;
  problem.block_planes(0, 0) = {};
  problem.block_planes(1, 0) = PlaneRange{-1, 1};   // the ground's own planes and no margin
  problem.block_planes(3, 3) = PlaneRange{20, 59};  // just below the roof
  const SweepProblem fine = narrowed(problem).problem;
  EXPECT_TRUE(fine.block_planes(0, 0).empty());
  for (int by = 0; by < 6; ++by) {
    for (int bx = 0; bx < 6; ++bx) {
      const PlaneRange asked = problem.block_planes(bx, by).hull(), left = fine.block_planes(bx, by).hull();
      EXPECT_TRUE(left.empty() || (asked.contains(left.first) && asked.contains(left.last))) << bx << ", " << by;
    }
  }
}

TEST(CoarseToFine, a_block_with_ground_and_roof_keeps_both_and_not_the_air_between) {
  const SweepProblem fine = narrowed(house().problem).problem;
  // Columns and rows 32 to 47: the west wall stands at column 32.5, ground within the reach of a coarse cell.
  const PlaneSet& planes = fine.planes_at(33, 40);
  EXPECT_GE(planes.ranges().size(), 2u);
  EXPECT_TRUE(planes.contains(0));
  EXPECT_TRUE(planes.contains(60));
  EXPECT_FALSE(planes.contains(30));
}

// Whether the wall of a house stands within three cells.
bool beside_a_wall(const Town& town, int column, int row) {
  for (int y = row - 3; y <= row + 3; ++y)
    for (int x = column - 3; x <= column + 3; ++x)
      if (town.true_plane(x, y) != town.true_plane(column, row)) return true;
  return false;
}

// Right beside walls the two differ: there the search from coarse to fine knows which views are hidden.
TEST(CoarseToFine, finds_the_heights_of_a_search_everywhere) {
  const Town& town = house();
  SweepProblem problem = town.problem;
  const Heights fast = heights_of(problem);
  problem.options.coarse_levels = 0;
  const Heights everywhere = heights_of(problem);
  int both = 0, near = 0, right_fast = 0, right_everywhere = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const double truth = town.true_plane(x, y) * kPlane;
      right_fast += std::abs(fast.height_m(x, y) - truth) <= kPlane;
      right_everywhere += std::abs(everywhere.height_m(x, y) - truth) <= kPlane;
      const double difference = std::abs(fast.height_m(x, y) - everywhere.height_m(x, y));
      if (std::isnan(difference) || beside_a_wall(town, x, y)) continue;
      ++both;
      near += difference <= 0.5 * kPlane;
    }
  }
  EXPECT_GT(both, 96 * 96 * 8 / 10);
  EXPECT_GE(near, 0.99 * both);
  EXPECT_GE(right_fast, right_everywhere);
}

TEST(CoarseToFine, does_not_depend_on_the_number_of_threads) {
  ThreadExecutor threads(3);
  double samples = 0;
  const NarrowedSearch one = narrowed(house().problem);
  const NarrowedSearch three = narrow_search(house().problem, Backend::cpu, threads, samples);
  EXPECT_EQ(one.problem.block_planes, three.problem.block_planes);
  EXPECT_EQ(one.problem.guide, three.problem.guide);
  EXPECT_TRUE(same(one.problem.expected_plane, three.problem.expected_plane));
  EXPECT_TRUE(same(one.mean_cost, three.mean_cost));
}

// What the smoothing of the fine grid is told.
TEST(CoarseToFine, tells_smoothing_of_slopes_and_edges_as_the_options_say) {
  SweepProblem problem = house().problem;
  EXPECT_FALSE(narrowed(problem).problem.expected_plane.empty());
  EXPECT_FALSE(narrowed(problem).problem.guide.empty());
  problem.options.follow_slopes = false;
  problem.options.edge_contrast = 0;
  EXPECT_TRUE(narrowed(problem).problem.expected_plane.empty());
  EXPECT_TRUE(narrowed(problem).problem.guide.empty());
}

TEST(CoarseToFine, a_higher_rival_tolerance_keeps_more_planes) {
  SweepProblem problem = house().problem;
  problem.options.rival_tolerance = 0;
  const double few = sample_count(narrowed(problem).problem);
  problem.options.rival_tolerance = 12;
  EXPECT_GT(sample_count(narrowed(problem).problem), few);
}

// Ten cells wide and forty planes high. A thin tall thing blurs with the ground on the coarsest grid; its height comes
// second there, at a price that only a high tolerance pays.
TEST(CoarseToFine, a_high_rival_tolerance_keeps_the_top_of_a_chimney) {
  const Town town(std::vector<hard::Box>{{{-0.5, -0.5, 0}, {0.5, 0.5, 4}}});
  SweepProblem problem = town.problem;
  problem.options.rival_tolerance = 12;
  const SweepProblem fine = narrowed(problem).problem;
  const Heights found = heights_of(problem);
  int kept = 0, right = 0;
  for (int y = 43; y < 53; ++y) {
    for (int x = 43; x < 53; ++x) {
      kept += fine.planes_at(x, y).contains(40);
      right += std::abs(found.height_m(x, y) - 4) <= 2 * kPlane;
    }
  }
  EXPECT_EQ(kept, 100);
  EXPECT_GT(right, 60);
}

// A street of 1.6 m between two rows of houses 6 m high: few views look down to its floor.
const Town& alley() {
  static const Town town(
      std::vector<hard::Box>{{{-3.8, -4, 0}, {-0.8, 4, kBoxTop}}, {{0.8, -4, 0}, {3.8, 4, kBoxTop}}});
  return town;
}

// Cells of the alley whose height is that of the floor, to two planes.
int floor_cells(const Heights& found) {
  int right = 0;
  for (int y = 16; y < 80; ++y)
    for (int x = 41; x < 55; ++x) right += std::abs(found.height_m(x, y)) <= 2 * kPlane;
  return right;
}

TEST(CoarseToFine, looking_past_the_houses_finds_more_of_the_floor_of_an_alley) {
  SweepProblem problem = alley().problem;
  problem.options.visibility_passes = 0;
  const int blind = floor_cells(heights_of(problem));
  EXPECT_FALSE(narrowed(problem).problem.visibility.any());
  problem.options.visibility_passes = 1;
  EXPECT_TRUE(narrowed(problem).problem.visibility.any());
  const int seeing = floor_cells(heights_of(problem));
  EXPECT_GT(seeing, 1.3 * blind);
  EXPECT_GT(seeing, 64 * 14 / 2);
}

// Each of the options changes what is found in the alley.
TEST(CoarseToFine, no_option_is_dead) {
  const Heights usual = heights_of(alley().problem);
  const auto differs = [&](auto change) {
    SweepProblem problem = alley().problem;
    change(problem.options);
    return !same(usual.height_m, heights_of(problem).height_m);
  };
  EXPECT_TRUE(differs([](SweepOptions& o) { o.coarse_levels = 1; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.rival_tolerance = 10; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.sure_excess = 0.5; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.follow_slopes = false; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.edge_contrast = 0; }));
  EXPECT_TRUE(differs([](SweepOptions& o) { o.hidden_cost = 40; }));
}

TEST(CoarseToFine, wrong_settings_are_refused_with_a_sentence) {
  const auto sentence = [](auto change) {
    SweepOptions options;
    change(options);
    return options.problem().value_or("");
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const int levels : {-1, 7})
    EXPECT_EQ(sentence([&](SweepOptions& o) { o.coarse_levels = levels; }),
              "coarse_levels must lie between 0 (search everywhere) and 6");
  for (const int passes : {-1, 9})
    EXPECT_EQ(sentence([&](SweepOptions& o) { o.visibility_passes = passes; }),
              "visibility_passes must lie between 0 and 8");
  for (const double tolerance : {-0.1, 60.1, kNaN})
    EXPECT_EQ(sentence([&](SweepOptions& o) { o.rival_tolerance = tolerance; }),
              "rival_tolerance must lie between 0 and 60 grey levels");
  for (const double cost : {-0.1, 60.1, kNaN})
    EXPECT_EQ(sentence([&](SweepOptions& o) { o.hidden_cost = cost; }),
              "hidden_cost must lie between 0 and 60 grey levels");
  for (const double excess : {-0.1, kNaN})
    EXPECT_EQ(sentence([&](SweepOptions& o) { o.sure_excess = excess; }),
              "sure_excess must be 0 or more (grey levels)");
}

// The best plane and its rival of one cell with these costs, from plane 10 on; the sums are those of equal paths.
struct Winner {
  int plane, rival_plane;
  float rival_excess;
};
Winner winner_of(const std::vector<double>& curve, PlaneSet planes) {
  SweepProblem problem;
  problem.grid = {1, 1, 1, {0, 0}};
  problem.search_everywhere({});
  problem.block_planes(0, 0) = planes;
  CostVolume costs(problem, 0), sums(problem, 0);
  auto value = curve.begin();
  for_each_stored_range(planes, [&](StoredRange range) {
    for (int i = range.slot; i < range.slot + range.planes.count(); ++i) {
      costs.cell(0, 0)[i] = quantized_cost(*value++);
      sums.cell(0, 0)[i] = kSmoothingPaths * costs.cell(0, 0)[i];
    }
  });
  const MatchResult found = best_planes(costs, sums);
  return {found.plane(0, 0), found.rival_plane(0, 0), found.rival_excess(0, 0)};
}

TEST(Rival, is_the_lowest_other_minimum) {
  const Winner winner = winner_of({9, 4, 9, 9, 9, 1, 9, 9, 9, 9, 9, 3.5, 9}, PlaneRange{10, 22});
  EXPECT_EQ(winner.plane, 15);
  EXPECT_EQ(winner.rival_plane, 21);
  EXPECT_FLOAT_EQ(winner.rival_excess, 2.5f);
}

TEST(Rival, the_slope_of_the_best_minimum_is_none_but_the_end_of_a_range) {
  const Winner winner = winner_of({5, 4, 3, 2, 1, 2, 3, 4, 5, 6, 7, 6.5}, PlaneRange{10, 21});
  EXPECT_EQ(winner.rival_plane, 21);
  EXPECT_FLOAT_EQ(winner.rival_excess, 5.5f);
}

TEST(Rival, a_minimum_near_the_best_is_part_of_it) {
  const Winner winner = winner_of({9, 9, 1, 5, 9, 2, 9, 9, 4, 9}, PlaneRange{10, 19});
  EXPECT_EQ(winner.plane, 12);
  EXPECT_EQ(winner.rival_plane, 18) << "plane 15 is 3 planes away";
  EXPECT_FLOAT_EQ(winner.rival_excess, 3);
}

TEST(Rival, may_lie_in_another_range_and_at_its_end) {
  PlaneSet planes(PlaneRange{10, 12});
  planes.include(PlaneRange{30, 33});
  const Winner winner = winner_of({9, 2, 9, 5, 6, 7, 8}, planes);
  EXPECT_EQ(winner.plane, 11);
  EXPECT_EQ(winner.rival_plane, 30);
  EXPECT_FLOAT_EQ(winner.rival_excess, 3);
}

TEST(Rival, there_is_none_where_all_planes_are_near) {
  EXPECT_TRUE(std::isinf(winner_of({3, 1, 3, 2}, PlaneRange{10, 13}).rival_excess));
}

}  // namespace
}  // namespace skysweep::sweep
