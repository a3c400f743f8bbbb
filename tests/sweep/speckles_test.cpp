// SPDX-License-Identifier: Apache-2.0
#include "sweep/speckles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

constexpr double kPlaneStep = 0.1;

// A plain at 0 with blocks of cells at heights given by a formula.
class Speckles : public testing::Test {
 protected:
  Speckles() {
    problem_.grid = {40, 40, 0.1, {0, 4}};
    problem_.dz_m = kPlaneStep;
    problem_.options.speckle_cells = 32;
    problem_.search_everywhere({-10, 200});
    problem_.options.speckle_cells = 32;
    heights_ = {Array2d<float>(40, 40, 0.0f), Array2d<float>(40, 40, 0.01f)};
  }

  template <typename F>
  void put(int column, int row, int width, int height, F z) {
    for (int y = row; y < row + height; ++y)
      for (int x = column; x < column + width; ++x) heights_.height_m(x, y) = static_cast<float>(z(x, y));
  }

  // Cells of a block that are taken back; those outside must all stay.
  int taken_back(int column, int row, int width, int height) {
    const Heights before = heights_;
    drop_speckles(problem_, heights_);
    int inside = 0, all = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const bool gone = std::isnan(heights_.height_m(x, y)) && !std::isnan(before.height_m(x, y));
        EXPECT_EQ(std::isnan(heights_.height_m(x, y)), std::isnan(heights_.sigma_m(x, y)));
        all += gone;
        inside += gone && x >= column && x < column + width && y >= row && y < row + height;
      }
    }
    EXPECT_EQ(all, inside);
    return inside;
  }

  SweepProblem problem_;
  Heights heights_;
};

// Every cell more than two planes from the next, none more than eight.
double uneven(int x, int y) { return 5 + 0.4 * ((x + y) % 2); }

TEST_F(Speckles, small_uneven_patches_are_not_believed) {
  put(10, 12, 4, 5, uneven);
  EXPECT_EQ(taken_back(10, 12, 4, 5), 20);
}

TEST_F(Speckles, single_cells_above_and_below_are_not_believed) {
  put(5, 5, 1, 1, [](int, int) { return 3; });
  put(20, 9, 1, 1, [](int, int) { return -0.9; });
  EXPECT_EQ(taken_back(0, 0, 40, 40), 2);
}

TEST_F(Speckles, patches_among_nothing_but_patches_stay) {
  Random random(4);
  put(0, 0, 40, 40, [&](int, int) { return random.uniform(0, 20); });  // the crown of a tree
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
}

TEST_F(Speckles, the_level_top_of_a_mast_stays) {
  Random random(3);
  put(10, 12, 3, 3, [&](int, int) { return 14 + random.uniform(-0.08, 0.08); });
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
}

TEST_F(Speckles, a_long_wall_one_cell_thick_stays) {
  put(2, 20, 36, 1, [](int x, int) { return 1.6 + 0.01 * x; });
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
}

TEST_F(Speckles, uneven_patches_of_some_size_stay) {
  put(10, 12, 8, 4, uneven);
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
}

TEST_F(Speckles, rough_and_steep_ground_stays) {
  Random random(5);
  put(0, 0, 40, 40, [&](int x, int) { return 0.5 * x + random.uniform(-0.1, 0.1); });
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
}

TEST_F(Speckles, fewer_speckle_cells_take_less_and_0_takes_nothing) {
  put(10, 12, 4, 5, uneven);
  problem_.options.speckle_cells = 20;
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
  put(5, 5, 1, 1, [](int, int) { return 3; });
  problem_.options.speckle_cells = 0;
  EXPECT_EQ(taken_back(0, 0, 40, 40), 0);
}

TEST_F(Speckles, wrong_numbers_are_refused_with_a_sentence) {
  for (const int cells : {-1, 65537}) {
    problem_.options.speckle_cells = cells;
    const auto sentence = problem_.options.problem();
    ASSERT_TRUE(sentence) << cells;
    EXPECT_NE(sentence->find("speckle_cells must lie between 0 (off) and 65536"), std::string::npos);
  }
}

}  // namespace
}  // namespace skysweep::sweep
