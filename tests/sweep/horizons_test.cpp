// SPDX-License-Identifier: Apache-2.0
#include "sweep/horizons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {
namespace {

constexpr float kEverything = -std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

constexpr int kWall = 50, kRow = 20;  // the wall's column, and the row of the eye
constexpr double kWallTop = 10, kEyeHeight = 20;

// Level ground at 0 with a wall from north to south, one cell thick; the eye stands 40 cells west of it.
struct WalledGround {
  Grid grid{100, 40, 0.5, {0, 20}};
  Array2d<float> surface{100, 40, 0.0f};
  Array2d<std::uint8_t> wanted{100, 40, 1};
  Vec3d eye;

  WalledGround() {
    for (int row = 0; row < 40; ++row) surface(kWall, row) = kWallTop;
    const Vec2d place = grid.cell_center(kWall - 40, kRow);
    eye = {place.x, place.y, kEyeHeight};
  }

  Horizons horizons(double lowest_m = -5, double tolerance_m = 0, int skipped_cells = 0) const {
    const camera::Camera camera({320, 240, 300, 300, 160, 120, {}},
                                {camera::rotation_from_yaw_pitch_roll(0, -90, 0), eye});
    SerialExecutor serial;
    return {grid, {View{nullptr, camera, 0}}, {surface, wanted, lowest_m, tolerance_m, skipped_cells}, serial};
  }

  // Similar triangles: the line from the eye over an edge of height `top`, `edge` cells away, meets the vertical
  // `cells` cells away at this height.
  static double over_edge(double top, double edge, double cells) {
    return kEyeHeight - (kEyeHeight - top) * cells / edge;
  }
};

TEST(Horizons, behind_a_wall_the_line_over_its_top_tells_the_lowest_visible_height) {
  const WalledGround world;
  const Horizons horizons = world.horizons();
  for (const int cells : {41, 45, 55})
    EXPECT_NEAR(horizons.lowest_visible(0, kWall - 40 + cells, kRow), WalledGround::over_edge(10, 40, cells), 1e-5);
}

TEST(Horizons, before_and_far_behind_a_wall_level_ground_hides_what_lies_below_it) {
  const WalledGround world;
  const Horizons horizons = world.horizons();
  // The ground one cell nearer to the eye is the edge: the line over it is a little below 0 at the cell.
  for (const int cells : {10, 30, 40, 85})
    EXPECT_NEAR(horizons.lowest_visible(0, kWall - 40 + cells, kRow), WalledGround::over_edge(0, cells - 1, cells),
                1e-5);
}

TEST(Horizons, beside_a_wall_that_ends_nothing_of_it_counts) {
  WalledGround world;
  for (int row = 0; row < 40; ++row) world.surface(kWall, row) = row >= 10 && row < 30 ? kWallTop : 0;
  const Horizons horizons = world.horizons();
  EXPECT_GT(horizons.lowest_visible(0, kWall + 5, kRow), 8);
  EXPECT_LT(horizons.lowest_visible(0, kWall + 5, 2), 0) << "the line of sight passes north of the wall";
  EXPECT_GT(horizons.lowest_visible(0, kWall + 5, 12), 8) << "obliquely through it";
}

TEST(Horizons, oblique_lines_meet_the_wall_where_they_cross_it) {
  WalledGround world;
  for (float& z : world.surface) z = kNaN;
  for (int row = 0; row < 40; ++row) world.surface(kWall, row) = kWallTop;
  // Both ends and the wall lie on one line of sight; its share of the way is the same as along the row.
  EXPECT_NEAR(world.horizons().lowest_visible(0, kWall + 10, kRow + 15), WalledGround::over_edge(10, 40, 50), 1e-5);
}

TEST(Horizons, a_place_of_which_nothing_is_hidden_has_no_lowest_height) {
  WalledGround world;
  const Horizons above_ground = world.horizons(0);
  EXPECT_EQ(above_ground.lowest_visible(0, kWall - 10, kRow), kEverything) << "nobody asks below the ground";
  EXPECT_EQ(above_ground.lowest_visible(0, kWall - 40, kRow), kEverything) << "below the eye";
  EXPECT_EQ(above_ground.lowest_visible(0, kWall - 39, kRow), kEverything) << "nothing between";
  EXPECT_GT(above_ground.lowest_visible(0, kWall + 10, kRow), 0);
}

TEST(Horizons, from_cells_that_are_not_wanted_everything_is_seen) {
  WalledGround world;
  world.wanted(kWall + 10, kRow) = 0;
  const Horizons horizons = world.horizons();
  EXPECT_EQ(horizons.lowest_visible(0, kWall + 10, kRow), kEverything);
  EXPECT_GT(horizons.lowest_visible(0, kWall + 11, kRow), 0);
}

TEST(Horizons, cells_without_height_hide_nothing) {
  WalledGround world;
  for (float& z : world.surface) z = kNaN;
  EXPECT_EQ(world.horizons().lowest_visible(0, kWall + 10, kRow), kEverything);
  world.surface(kWall, kRow) = kWallTop;
  EXPECT_NEAR(world.horizons().lowest_visible(0, kWall + 10, kRow), WalledGround::over_edge(10, 40, 50), 1e-5);
}

TEST(Horizons, the_tolerance_lowers_whatever_hides) {
  const WalledGround world;
  EXPECT_NEAR(world.horizons(-5, 2).lowest_visible(0, kWall + 10, kRow), WalledGround::over_edge(8, 40, 50), 1e-5);
}

TEST(Horizons, what_stands_within_the_skipped_cells_hides_nothing) {
  const WalledGround world;
  const auto lowest = [&](int skipped, int column) {
    return world.horizons(0, 0, skipped).lowest_visible(0, column, kRow);
  };
  EXPECT_NEAR(lowest(1, kWall + 2), WalledGround::over_edge(10, 40, 42), 1e-5);
  EXPECT_EQ(lowest(2, kWall + 2), kEverything);
  EXPECT_NEAR(lowest(2, kWall + 3), WalledGround::over_edge(10, 40, 43), 1e-5);
}

}  // namespace
}  // namespace skysweep::sweep
