// SPDX-License-Identifier: Apache-2.0
#include "report/height_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "height_cells.h"

namespace skysweep::report {
namespace {

// Columns of the eastward steps of a row of heights.
std::vector<int> steps_of(const std::vector<float>& row, double step_m = 1) {
  Array2d<float> heights(static_cast<int>(row.size()), 1);
  std::copy(row.begin(), row.end(), heights.begin());
  std::vector<int> columns;
  for (const HeightEdge& edge : height_edges(heights, step_m)) columns.push_back(edge.column);
  return columns;
}

using Columns = std::vector<int>;

TEST(HeightEdges, a_sharp_step_is_one_edge) {
  EXPECT_EQ(steps_of({2, 2, 2, 8, 8, 8}), Columns{2});
  EXPECT_EQ(steps_of({8, 8, 8, 2, 2, 2}), Columns{2});
  EXPECT_EQ(steps_of({2, 2, 2, 2.9f, 2.9f}), Columns{});
  EXPECT_EQ(steps_of({2, 8}), Columns{0});
  EXPECT_EQ(steps_of({2}), Columns{});
}

TEST(HeightEdges, a_step_spread_over_some_cells_is_one_edge) {
  EXPECT_EQ(steps_of({2, 2, 2, 5, 8, 8, 8}), Columns{2});  // of two equal sides the first
  EXPECT_EQ(steps_of({2, 2, 2, 4, 6, 8, 8, 8}), Columns{3});
  EXPECT_EQ(steps_of({2, 2, 2, 5, 4.9f, 8, 8, 8}).size(), 1u);  // noise inside it
  EXPECT_EQ(steps_of({2, 2.625f, 3.25f, 3.25f}), Columns{0});   // neither of the two is of a metre
}

TEST(HeightEdges, a_steady_slope_is_none_and_takes_nothing_away_from_a_step_on_it) {
  std::vector<float> slope, step;
  for (int i = 0; i < 20; ++i) {
    slope.push_back(0.9f * static_cast<float>(i));
    step.push_back(slope.back() + (i > 10 ? 3.0f : 0.0f));
  }
  EXPECT_EQ(steps_of({slope.begin() + 2, slope.end()}, 2.8), Columns{});
  const std::vector<int> edges = steps_of(step, 2.8);
  EXPECT_EQ(edges, Columns{10});
}

TEST(HeightEdges, an_object_of_one_cell_has_both_its_sides) {
  EXPECT_EQ(steps_of({2, 2, 2, 8, 2, 2, 2}), (Columns{2, 3}));
}

TEST(HeightEdges, the_border_of_a_hole_is_no_edge) {
  EXPECT_EQ(steps_of({2, 2, kHole, 8, 8}), Columns{});
  EXPECT_EQ(steps_of({kHole, 8, 8, kHole}), Columns{});
}

TEST(HeightEdges, steps_to_the_south_are_found_like_those_to_the_east) {
  Array2d<float> heights(3, 6, 2);
  for (int row = 3; row < 6; ++row)
    for (int column = 0; column < 3; ++column) heights(column, row) = 9;
  const std::vector<HeightEdge> edges = height_edges(heights, 1);
  ASSERT_EQ(edges.size(), 3u);
  for (const HeightEdge& edge : edges) {
    EXPECT_TRUE(edge.to_south);
    EXPECT_EQ(edge.row, 2);
    EXPECT_EQ(edge.y_half_cells(), 5);
  }
}

// A house of 8 m on ground of 2 m, 10 x 12 cells of a map of 40 x 40: 44 sides.
struct House {
  double cell_m = 1;
  int shift = 0;  // cells to the east
  float operator()(Vec2d p) const {
    const double x = p.x / cell_m - shift, y = p.y / cell_m;
    return x > 15 && x < 25 && y > 14 && y < 26 ? 8.0f : 2.0f;
  }
};

TEST(EdgeScore, a_perfect_map_has_them_all) {
  const EdgeScores scores = compare_edges(make_cells(40, 40, 1, House{}, House{}), 1, 1, nullptr);
  for (const EdgeScore& score : scores) {
    EXPECT_EQ(score.true_count, 44);
    EXPECT_EQ(score.measured_count, 44);
    EXPECT_EQ(score.precision(), 1);
    EXPECT_EQ(score.recall(), 1);
    EXPECT_EQ(score.f_score(), 1);
  }
}

TEST(EdgeScore, a_shift_of_two_cells_is_right_within_two_gsd_only) {
  const EdgeScores scores = compare_edges(make_cells(40, 40, 1, House{}, House{1, 2}), 1, 1, nullptr);
  EXPECT_EQ(scores[0].tolerance_m, 1);
  EXPECT_EQ(scores[1].tolerance_m, 2);
  // Within 1: the walls in the north and south less two cells at one end, of which one is a cell from the next side;
  // of a wall in the east or west only the ends lie near the others.
  EXPECT_LT(scores[0].f_score(), 0.5);
  EXPECT_GT(scores[0].f_score(), 0.3);
  EXPECT_EQ(scores[1].f_score(), 1);
}

TEST(EdgeScore, the_tolerance_is_never_below_a_cell) {
  const EdgeScores scores = compare_edges(make_cells(40, 40, 0.1, House{0.1}, House{0.1, 1}), 1, 0.05, nullptr);
  EXPECT_EQ(scores[0].tolerance_m, 0.1);
  EXPECT_EQ(scores[0].f_score(), 1);
  EXPECT_EQ(scores[1].tolerance_m, 0.2);
}

TEST(EdgeScore, a_blurred_wall_is_still_right) {
  const auto blurred = [](Vec2d p) {
    float sum = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) sum += House{}({p.x + i, p.y + j});
    return sum / 9;
  };
  const EdgeScore score = compare_edges(make_cells(40, 40, 1, House{}, blurred), 1, 1, nullptr)[0];
  EXPECT_EQ(score.recall(), 1);
  EXPECT_EQ(score.precision(), 1);
  EXPECT_LE(score.measured_count, 52);  // not three for each of the 44
}

TEST(EdgeScore, holes_are_misses_not_edges) {
  const auto west_unknown = [](Vec2d p) { return p.x < 20 ? kHole : House{}(p); };
  const EdgeScore score = compare_edges(make_cells(40, 40, 1, House{}, west_unknown), 1, 1, nullptr)[0];
  EXPECT_EQ(score.measured_count, 22);
  EXPECT_EQ(score.precision(), 1);
  EXPECT_EQ(score.true_count, 44);
  EXPECT_EQ(score.true_found, 24);  // 22, and two sides that lie a cell beside the hole
}

TEST(EdgeScore, edges_where_the_truth_is_unknown_do_not_count) {
  const auto house_unknown = [](Vec2d p) { return p.x < 20 ? kHole : House{}(p); };
  const EdgeScore score = compare_edges(make_cells(40, 40, 1, house_unknown, House{}), 1, 1, nullptr)[0];
  EXPECT_EQ(score.true_count, 22);
  EXPECT_EQ(score.measured_count, 22);
}

TEST(EdgeScore, nothing_measured_and_nothing_true) {
  const auto flat = [](Vec2d) { return 2.0f; };
  const EdgeScore missed = compare_edges(make_cells(40, 40, 1, House{}, flat), 1, 1, nullptr)[0];
  EXPECT_TRUE(std::isnan(missed.precision()));
  EXPECT_EQ(missed.recall(), 0);
  EXPECT_EQ(missed.f_score(), 0);
  EXPECT_TRUE(std::isnan(compare_edges(make_cells(40, 40, 1, flat, flat), 1, 1, nullptr)[0].f_score()));
}

TEST(EdgeScore, noise_elsewhere_leaves_the_score_of_a_region_alone) {
  Random random(9);
  const auto noisy = [&](Vec2d p) { return House{}(p) + (p.y > 30 ? static_cast<float>(3 * random.normal()) : 0.0f); };
  const HeightDifferences cells = make_cells(40, 40, 1, House{}, noisy);
  Array2d<std::uint8_t> south(40, 40), north(40, 40);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) (row < 12 ? north : south)(column, row) = 1;
  EXPECT_LT(compare_edges(cells, 1, 1, nullptr)[0].precision(), 0.5);
  EXPECT_EQ(compare_edges(cells, 1, 1, &south)[0].f_score(), 1);
  EXPECT_EQ(compare_edges(cells, 1, 1, &north)[0].true_count, 0);
  EXPECT_EQ(compare_edges(cells, 1, 1, &north)[0].measured_right, 0);
  EXPECT_GT(compare_edges(cells, 1, 1, &north)[0].measured_count, 50);
}

}  // namespace
}  // namespace skysweep::report
