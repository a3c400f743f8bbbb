// SPDX-License-Identifier: Apache-2.0
#include "sweep/filling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "sweep/hidden_cells.h"
#include "sweep/orthophoto.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

const float kNaN = std::nanf("");

// A surface given by a formula, known wherever `known` says so, below cameras 30 m up.
class Filling : public testing::Test {
 protected:
  using Known = std::function<bool(double x, double y)>;

  Filling() {
    problem_.grid = {80, 80, 0.1, {-4, 4}};
    problem_.dz_m = 0.05;
    problem_.search_everywhere({-100, 400});
  }

  // Level cameras at (x, y), each of which shows the whole grid.
  void add_views(const std::vector<Vec2d>& places) {
    const camera::CameraModel model = test::small_camera(120, 160, 120);
    for (const Vec2d place : places) {
      images_.emplace_back(Array2d<Rgb8>(160, 120, Rgb8{90, 120, 60}));
      problem_.views.push_back(
          {&images_.back(),
           camera::Camera(model, {camera::rotation_from_yaw_pitch_roll(0, -90, 0), {place.x, place.y, 30}}), 0});
    }
  }
  // Four to the west and one to the east of the grid: of the wall's two sides four see one, and one sees the other.
  void look_mostly_from_the_west() { add_views({{-8, -2}, {-8, 2}, {-9, 0}, {-7, 0}, {8, 0}}); }

  Heights heights_of(const test::Surface& surface, const Known& known) const {
    Heights h{Array2d<float>(80, 80, kNaN), Array2d<float>(80, 80, kNaN)};
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) {
        const Vec2d c = problem_.grid.cell_center(x, y);
        if (!known(c.x, c.y)) continue;
        h.height_m(x, y) = static_cast<float>(surface(c.x, c.y));
        h.sigma_m(x, y) = 0.02f;
      }
    }
    return h;
  }
  Array2d<std::uint8_t> fill(Heights& heights) { return fill_hidden_cells(problem_, executor_, heights); }

  // Largest error of the filled cells, and how many there are.
  struct Filled {
    int cells = 0;
    double largest_error_m = 0;
  };
  Filled compare(const Heights& heights, const Array2d<std::uint8_t>& filled, const test::Surface& surface) const {
    Filled out;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) {
        if (!filled(x, y)) continue;
        const Vec2d c = problem_.grid.cell_center(x, y);
        ++out.cells;
        out.largest_error_m = std::max(out.largest_error_m, std::abs(heights.height_m(x, y) - surface(c.x, c.y)));
        EXPECT_TRUE(std::isnan(heights.sigma_m(x, y)));
      }
    }
    return out;
  }

  SerialExecutor executor_;
  SweepProblem problem_;
  std::deque<ImagePyramid> images_;
};

// A building of 10 m west of x = 0; of the strip east of it (to x = 1.5) nothing was measured.
double building(double x, double) { return x < 0 ? 10 : 0; }
bool beside_strip(double x, double) { return x < 0 || x > 1.5; }

TEST_F(Filling, the_far_side_of_a_building_gets_the_height_of_the_ground) {
  look_mostly_from_the_west();
  Heights heights = heights_of(building, beside_strip);
  const Filled filled = compare(heights, fill(heights), building);
  EXPECT_EQ(filled.cells, 15 * 80);
  EXPECT_EQ(filled.largest_error_m, 0);
}

TEST_F(Filling, what_two_views_see_stays_as_it_is) {
  add_views({{8, -2}, {8, 2}, {9, 0}, {7, 0}, {-8, 0}});
  Heights heights = heights_of(building, beside_strip);
  EXPECT_EQ(compare(heights, fill(heights), building).cells, 0);
  EXPECT_TRUE(std::isnan(heights.height_m(42, 40)));
}

TEST_F(Filling, gaps_in_open_ground_and_in_roofs_stay) {
  look_mostly_from_the_west();
  const auto low_building = [](double x, double) { return x < 0 ? 3 : 0; };  // its shadow is 0.9 m wide
  Heights heights = heights_of(low_building, [](double x, double y) { return std::hypot(std::abs(x) - 2.5, y) > 0.4; });
  EXPECT_EQ(compare(heights, fill(heights), low_building).cells, 0);
}

TEST_F(Filling, a_light_well_whose_floor_nobody_measured_is_not_filled_from_the_roof) {
  look_mostly_from_the_west();
  Heights heights =
      heights_of([](double, double) { return 10; }, [](double x, double y) { return std::hypot(x, y) > 1; });
  EXPECT_EQ(compare(heights, fill(heights), building).cells, 0);
}

TEST_F(Filling, an_alley_open_at_its_ends_is_filled_along_its_floor) {
  const auto alley = [](double x, double y) { return std::abs(x) < 0.5 && std::abs(y) < 3 ? 0.1 * y : 10.0; };
  look_mostly_from_the_west();
  Heights heights = heights_of([&](double x, double y) { return std::abs(y) < 3 ? alley(x, y) : 0.1 * y; },
                               [](double x, double y) { return !(std::abs(x) < 0.5 && std::abs(y) < 2.5); });
  const Array2d<std::uint8_t> filled = fill(heights);
  const Filled result = compare(heights, filled, alley);
  EXPECT_EQ(result.cells, 10 * 50);
  EXPECT_LT(result.largest_error_m, 0.05);
}

TEST_F(Filling, on_a_slope_it_goes_on_with_the_slope) {
  const auto slope = [](double x, double y) { return x < 0 ? 12.0 : 0.2 * y; };
  look_mostly_from_the_west();
  Heights heights = heights_of(slope, [](double x, double y) { return x < 0 || x > 1 || std::abs(y) > 2; });
  const Filled filled = compare(heights, fill(heights), slope);
  EXPECT_EQ(filled.cells, 10 * 40);
  EXPECT_LT(filled.largest_error_m, 0.11);
}

TEST_F(Filling, beyond_the_border_where_few_photographs_look_nothing_is_filled) {
  add_views({{-8, -2}, {-8, 2}, {-9, 0}});  // fewer than twice min_views
  Heights heights = heights_of(building, beside_strip);
  EXPECT_EQ(compare(heights, fill(heights), building).cells, 0);
}

TEST_F(Filling, min_views_decides_how_many_views_must_see_a_cell) {
  add_views({{8, -2}, {8, 2}, {-9, 0}, {-7, 0}, {-8, 0}, {-8, 1}});
  Heights two_see_it = heights_of(building, beside_strip), three_must = two_see_it;
  EXPECT_EQ(compare(two_see_it, fill(two_see_it), building).cells, 0);
  problem_.options.min_views = 3;
  EXPECT_EQ(compare(three_must, fill(three_must), building).cells, 15 * 80);
}

TEST_F(Filling, without_the_option_nothing_changes) {
  look_mostly_from_the_west();
  problem_.options.fill = false;
  Heights heights = heights_of(building, beside_strip);
  EXPECT_EQ(compare(heights, fill(heights), building).cells, 0);
  EXPECT_TRUE(std::isnan(heights.height_m(45, 40)));
}

TEST_F(Filling, is_the_same_for_any_number_of_threads) {
  look_mostly_from_the_west();
  const auto known = [](double x, double y) { return x < 0 || x > 1.5 + 0.5 * std::sin(5 * y); };
  const auto rough = [](double x, double y) { return x < 0 ? 10 + 0.1 * std::sin(7 * y) : 0.2 * std::sin(3 * x + y); };
  Heights one = heights_of(rough, known), three = one;
  const Array2d<std::uint8_t> filled = fill(one);
  ThreadExecutor threads(3);
  EXPECT_EQ(fill_hidden_cells(problem_, threads, three), filled);
  for (std::size_t i = 0; i < filled.size(); ++i)
    if (filled.data()[i]) {
      EXPECT_EQ(one.height_m.data()[i], three.height_m.data()[i]);
    }
}

TEST_F(Filling, filled_cells_have_the_colour_of_the_one_view_that_sees_them) {
  look_mostly_from_the_west();
  Heights heights = heights_of(building, beside_strip);
  SweepResult result;
  result.filled = fill(heights);
  result.height_m = heights.height_m;
  colorize(problem_, executor_, result);
  EXPECT_EQ(result.view_count(42, 40), 1);
  EXPECT_EQ(result.color_view(42, 40), 4);
  EXPECT_EQ(result.color(42, 40).a, 255);
}

TEST_F(Filling, small_gaps_are_closed_when_asked_large_ones_are_not) {
  look_mostly_from_the_west();
  // Gaps of about 50 and 12 cells in a roof of 10 m.
  const auto known = [](double x, double y) { return std::hypot(x + 2, y) > 0.4 && std::hypot(x + 1, y - 2) > 0.2; };
  const auto roof = [](double x, double) { return 10 + 0.1 * x; };
  Heights untouched = heights_of(roof, known), small = untouched, both = untouched;
  EXPECT_EQ(compare(untouched, fill(untouched), roof).cells, 0);
  problem_.options.close_gap_cells = 30;
  const Filled one = compare(small, fill(small), roof);
  EXPECT_EQ(one.cells, 12);
  EXPECT_LT(one.largest_error_m, 0.01);
  problem_.options.close_gap_cells = 100;
  EXPECT_GT(compare(both, fill(both), roof).cells, 12 + 30);
}

TEST_F(Filling, a_wrong_size_of_gaps_is_refused_with_a_sentence) {
  for (const int cells : {-1, 65537}) {
    problem_.options.close_gap_cells = cells;
    const auto sentence = problem_.options.problem();
    ASSERT_TRUE(sentence) << cells;
    EXPECT_NE(sentence->find("close_gap_cells must lie between 0 (off) and 65536"), std::string::npos);
  }
}

TEST(Background, is_the_distance_weighted_mean_of_the_lower_side) {
  // The cell at (2, 4) has known ones 2 cells to the west, 6 to the east and 4 to the north.
  Array2d<float> surface(9, 9, kNaN);
  SerialExecutor executor;
  const auto height = [&] { return Background(surface, 1, 0.1, executor).height_at(2, 4); };
  surface(0, 4) = 1;
  EXPECT_TRUE(std::isnan(height())) << "one height alone may be wrong";
  surface(8, 4) = 1.4f;
  EXPECT_FLOAT_EQ(height(), 1.1f);
  surface(2, 0) = 6;  // steeper than half the distance: the other side of a step
  EXPECT_FLOAT_EQ(height(), 1.1f);
  surface(0, 4) = -9;  // lower than all others, and alone
  EXPECT_TRUE(std::isnan(height()));
}

}  // namespace
}  // namespace skysweep::sweep
