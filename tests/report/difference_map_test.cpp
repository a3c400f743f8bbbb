// SPDX-License-Identifier: Apache-2.0
#include "report/difference_map.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "height_cells.h"

namespace skysweep::report {
namespace {

constexpr Rgb8 kWhite{255, 255, 255};

std::tuple<int, int, int> key(Rgb8 c) { return {c.r, c.g, c.b}; }

// A map whose measured heights are `dz` above a truth of 10 m.
HeightDifferences with_error(int side, float dz) {
  return make_cells(
      side, side, 1, [](Vec2d) { return 10.0f; }, [dz](Vec2d) { return 10 + dz; });
}

TEST(DifferenceMap, too_high_is_red_too_low_is_blue_right_is_light) {
  EXPECT_GT(difference_color(0.5).r, difference_color(0.5).b + 50);
  EXPECT_GT(difference_color(-0.5).b, difference_color(-0.5).r + 50);
  EXPECT_EQ(key(difference_color(0)), key({246, 246, 246}));
  EXPECT_EQ(key(difference_color(7)), key(difference_color(1)));
  EXPECT_EQ(key(difference_color(-7)), key(difference_color(-1)));
  const DifferenceMapOptions options{2};
  EXPECT_EQ(key(difference_map(with_error(8, 1), options)(10, 10)), key(difference_color(0.5)));
  EXPECT_EQ(key(difference_map(with_error(8, -2), options)(10, 10)), key(difference_color(-1)));
}

TEST(DifferenceMap, holes_and_unknown_truth_have_colours_of_their_own) {
  const auto truth = [](Vec2d p) { return p.x < 2 ? kHole : 10.0f; };
  const auto measured = [](Vec2d p) { return p.x > 6 ? kHole : 10.0f; };
  const Array2d<Rgb8> map = difference_map(make_cells(8, 8, 1, truth, measured), {1});  // 60 pixels a cell
  std::set<std::tuple<int, int, int>> hole, unknown, known;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 120; ++x) unknown.insert(key(map(x, y)));
    for (int x = 120; x < 360; ++x) known.insert(key(map(x, y)));
    for (int x = 360; x < 480; ++x) hole.insert(key(map(x, y)));
  }
  EXPECT_EQ(unknown.size(), 1u);
  EXPECT_EQ(known.size(), 1u);
  EXPECT_EQ(hole.size(), 2u);  // stripes
  for (const auto& color : hole) {
    EXPECT_FALSE(unknown.count(color));
    for (int i = -100; i <= 100; ++i) EXPECT_NE(color, key(difference_color(i / 100.0)));
  }
  for (int i = -100; i <= 100; ++i) EXPECT_NE(*unknown.begin(), key(difference_color(i / 100.0)));
}

TEST(DifferenceMap, small_maps_are_magnified_and_large_ones_thinned) {
  EXPECT_EQ(difference_map(with_error(100, 0), {1}).width(), 460);  // four pixels a cell, and the legend is wider
  EXPECT_EQ(difference_map(with_error(600, 0), {1}).width(), 600);
  const Array2d<Rgb8> thinned = difference_map(with_error(1001, 1), {1, 500});
  EXPECT_EQ(thinned.width(), 460);  // 334 pixels, and the legend
  EXPECT_EQ(key(thinned(333, 333)), key(difference_color(1)));
}

TEST(DifferenceMap, no_label_of_the_legend_is_cut_off) {
  for (const double limit : {0.15, 3., 0.0125, 1234.}) {
    const Array2d<Rgb8> map = difference_map(with_error(4, 0), {limit});
    for (int y = 480; y < map.height(); ++y)
      for (const int x : {0, 1, map.width() - 2, map.width() - 1}) EXPECT_EQ(key(map(x, y)), key(kWhite)) << limit;
  }
}

}  // namespace
}  // namespace skysweep::report
