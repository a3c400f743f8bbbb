// SPDX-License-Identifier: Apache-2.0
#include "sweep/visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

// The same question without any jump: every step of the ray looked at.
bool sees_step_by_step(const Grid& grid, const Array2d<float>& surface, double tolerance, Vec3d eye, int column,
                       int row, double z) {
  const Vec2d cell = grid.cell_center(column, row);
  const double dx = (eye.x - cell.x) / grid.cell_m, dy = (cell.y - eye.y) / grid.cell_m;
  const double steps = std::max(std::abs(dx), std::abs(dy));
  if (steps < 1) return true;
  if (eye.z <= z) return false;
  for (int i = 1; i <= steps; ++i) {
    const int x = static_cast<int>(std::lround(column + i * dx / steps));
    const int y = static_cast<int>(std::lround(row + i * dy / steps));
    if (!surface.contains(x, y)) return true;
    if (surface(x, y) > z + i * (eye.z - z) / steps + tolerance) return false;
  }
  return true;
}

TEST(SurfaceVisibility, a_wall_hides_what_lies_in_its_shadow_and_nothing_else) {
  const Grid grid{100, 100, 0.5, {0, 50}};
  Array2d<float> surface(100, 100, 0.0f);
  for (int row = 0; row < 100; ++row) surface(50, row) = 10;  // a wall from north to south at x = 25.25
  const SurfaceVisibility visibility(grid, surface, 0.01);
  const Vec3d eye{5.25, 25.25, 20};  // 20 m west of the wall and 10 m above its top: the shadow is 20 m long
  EXPECT_TRUE(visibility.sees(eye, 30, 49, 0));
  EXPECT_TRUE(visibility.sees(eye, 50, 49, 10));
  EXPECT_FALSE(visibility.sees(eye, 52, 49, 0));
  EXPECT_FALSE(visibility.sees(eye, 88, 49, 0));
  EXPECT_TRUE(visibility.sees(eye, 92, 49, 0));
  EXPECT_TRUE(visibility.sees(eye, 52, 49, 9.9));
}

TEST(SurfaceVisibility, cells_without_height_hide_nothing) {
  const Grid grid{40, 40, 1, {0, 40}};
  Array2d<float> surface(40, 40, std::numeric_limits<float>::quiet_NaN());
  surface(5, 5) = 0;
  const SurfaceVisibility visibility(grid, surface, 0.01);
  EXPECT_TRUE(visibility.sees({39, 1, 3}, 5, 5, 0));
}

TEST(SurfaceVisibility, nothing_is_seen_from_below) {
  const Grid grid{10, 10, 1, {0, 10}};
  const Array2d<float> surface(10, 10, 5.0f);
  EXPECT_FALSE(SurfaceVisibility(grid, surface, 0.1).sees({50, 50, 4}, 5, 5, 5));
}

TEST(SurfaceVisibility, jumping_over_blocks_gives_what_every_single_step_gives) {
  Random random(11);
  const Grid grid{90, 70, 0.25, {-3, 12}};
  Array2d<float> surface(90, 70, 0.0f);
  for (int i = 0; i < 60; ++i) {
    const int x = random.below(85), y = random.below(65), size = 1 + random.below(5);
    const auto height = static_cast<float>(random.uniform(0.5, 6));
    for (int v = y; v < y + size; ++v)
      for (int u = x; u < x + size; ++u) surface(u, v) = height;
  }
  const SurfaceVisibility visibility(grid, surface, 0.05);
  int hidden = 0;
  for (int i = 0; i < 20000; ++i) {
    const int column = random.below(90), row = random.below(70);
    const Vec3d eye{random.uniform(-20, 40), random.uniform(-20, 30), random.uniform(3, 30)};
    const double z = surface(column, row);
    const bool expected = sees_step_by_step(grid, surface, 0.05, eye, column, row, z);
    hidden += !expected;
    ASSERT_EQ(visibility.sees(eye, column, row, z), expected)
        << column << " " << row << " from " << eye.x << " " << eye.y;
  }
  EXPECT_GT(hidden, 1000);
}

}  // namespace
}  // namespace skysweep::sweep
