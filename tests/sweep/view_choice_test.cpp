// SPDX-License-Identifier: Apache-2.0
#include "sweep/view_choice.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

ColorCandidate candidate(int view, int grey, double slope) {
  const auto byte = static_cast<std::uint8_t>(grey);
  return {{byte, byte, byte}, static_cast<std::int8_t>(view), static_cast<std::uint8_t>(slope * kSlopeScale)};
}

CellCandidates cell_of(std::initializer_list<ColorCandidate> candidates) {
  CellCandidates cell;
  for (const ColorCandidate& c : candidates) cell.of[cell.count++] = c;
  cell.seen_by = cell.count;
  return cell;
}

// Two views either of which is the better one by chance, cell by cell. They look alike in the columns below 24 and
// differ by 40 grey levels in the others.
Array2d<CellCandidates> two_views() {
  Random random(5);
  Array2d<CellCandidates> cells(48, 48);
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x) {
      const double first_slope = random.uniform(0, 0.25), second_slope = random.uniform(0, 0.25);
      const ColorCandidate first = candidate(0, 100, first_slope),
                           second = candidate(1, x < 24 ? 100 : 140, second_slope);
      cells(x, y) = first_slope <= second_slope ? cell_of({first, second}) : cell_of({second, first});
    }
  return cells;
}

// Neighbours with different views in some columns.
int seams(const Array2d<CellCandidates>& cells, double seam_cost, int first_column, int last_column) {
  SerialExecutor serial;
  const Array2d<std::int8_t> chosen = choose_views(cells, seam_cost, serial);
  const auto view = [&](int x, int y) { return cells(x, y).of[chosen(x, y)].view; };
  int count = 0;
  for (int y = 0; y < cells.height(); ++y)
    for (int x = first_column; x < last_column; ++x) count += view(x, y) != view(x + 1, y);
  return count;
}

TEST(ViewChoice, seams_are_few_and_fewest_where_they_would_show) {
  const Array2d<CellCandidates> cells = two_views();
  const int alone = seams(cells, 0, 0, 23), alike = seams(cells, 1, 0, 23), different = seams(cells, 1, 24, 47);
  EXPECT_GT(alone, 400);
  EXPECT_LT(alike, alone / 3);
  EXPECT_LT(different, alike * 9 / 10);
}

TEST(ViewChoice, a_view_that_the_others_contradict_is_not_taken) {
  const CellCandidates cell = cell_of({candidate(4, 200, 0.05), candidate(2, 100, 0.3), candidate(0, 103, 0.4)});
  const auto deviation = deviations(cell);
  EXPECT_EQ(deviation[0], 97 * 16);
  EXPECT_EQ(deviation[2], 0);
  SerialExecutor serial;
  EXPECT_EQ(choose_views(Array2d<CellCandidates>(3, 3, cell), 1, serial)(1, 1), 1);
}

TEST(ViewChoice, of_two_views_neither_is_contradicted) {
  const CellCandidates cell = cell_of({candidate(1, 200, 0.05), candidate(2, 100, 0.3)});
  EXPECT_EQ(deviations(cell)[0], 0);
  EXPECT_EQ(deviations(cell)[1], 0);
}

TEST(ViewChoice, does_not_depend_on_what_lies_beyond_its_reach) {
  SerialExecutor serial;
  Array2d<CellCandidates> cells(60, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      const int noise = (x * 37 + y * 61 + x * y) % 23;
      cells(x, y) = cell_of({candidate(0, 100 + noise, 0.2), candidate(1, 112, 0.2), candidate(2, 100, 0.25)});
    }
  const Array2d<std::int8_t> usual = choose_views(cells, 1, serial);
  for (int y = 0; y < 60; ++y) cells(59, y) = cell_of({candidate(2, 0, 0)});
  const Array2d<std::int8_t> other = choose_views(cells, 1, serial);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 59 - kChoiceReach; ++x) EXPECT_EQ(usual(x, y), other(x, y)) << x << ", " << y;
  EXPECT_NE(usual, other);
}

TEST(ViewChoice, gives_the_same_for_any_number_of_threads) {
  SerialExecutor serial;
  ThreadExecutor threads(3);
  const Array2d<CellCandidates> cells = two_views();
  EXPECT_EQ(choose_views(cells, 1, serial), choose_views(cells, 1, threads));
}

TEST(ViewChoice, cells_without_views_stay_without) {
  SerialExecutor serial;
  EXPECT_EQ(choose_views(Array2d<CellCandidates>(2, 2), 1, serial)(1, 0), -1);
}

}  // namespace
}  // namespace skysweep::sweep
