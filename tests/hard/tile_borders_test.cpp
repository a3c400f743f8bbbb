// SPDX-License-Identifier: Apache-2.0
// Hard case: the border of a tile. Paths of the smoothing, coarse grids and windows end there, and the neighbour's do
// not: with collars too narrow, neighbours disagree about what both compute.
#include "hard/box_world.h"
#include "hard/sound_result.h"

namespace skysweep::hard {
namespace {

constexpr int kCollar = 32, kWidth = 160, kHeight = 96, kShift = kWidth - 2 * kCollar;

// Two neighbours over houses with a street between, of the same photographs; B begins kShift cells further east. Of the
// collar that they share, A keeps the western half and B the eastern. A third tile has the border in its middle.
struct Neighbours {
  explicit Neighbours(double moved_east) : world(houses()), moved_east_m(moved_east) {
    world.add_ring(8, test::small_camera(), 6, 30);
    world.set_grid(kHeight, 0.1, 0.1, -2, 8);
    world.problem.grid.width = kWidth;
    world.problem.search_everywhere(world.problem.all_planes());
    a = sweep_from(-0.1 * (kCollar + kShift));
    over_the_border = sweep_from(0.1 * (kCollar - kWidth / 2) - 0.1 * kCollar);
    b = sweep_from(-0.1 * kCollar);
  }

  sweep::SweepResult sweep_from(double west) {
    world.problem.grid.north_west_corner.x = west + moved_east_m;
    SerialExecutor serial;
    return sweep::plane_sweep(world.problem, sweep::Backend::cpu, serial);
  }

  static BoxWorld houses() {
    BoxWorld world;
    world.ground_z = 0.03;
    world.boxes = {{{-2.1, -3.9, -1}, {1.7, -0.8, 4.02}}, {{-1.2, 1.1, -1}, {2.6, 4.3, 2.57}}};
    return world;
  }

  double truth_at(const sweep::Grid& grid, int column, int row) const {
    const Vec2d cell = grid.cell_center(column, row);
    return world.world.top(cell.x, cell.y);
  }

  // Whether B's cell has no wall within so many cells.
  bool is_level_around(int column, int row, int cells) const {
    const sweep::Grid& grid = world.problem.grid;
    for (int v = row - cells; v <= row + cells; ++v)
      for (int u = column - cells; u <= column + cells; ++u)
        if (truth_at(grid, u, v) != truth_at(grid, column, row)) return false;
    return true;
  }

  WorldProblem world;
  double moved_east_m;
  sweep::SweepResult a, b, over_the_border;
};

// Borders through the street, along its walls and through the houses.
constexpr double kPlacesOfTheBorder[] = {-2.4, -1.6, -0.8, 0, 0.8, 1.6, 2.4};

// Bound: 0.8 m and more from any wall, 99.5 % of the cells that both compute agree to half a plane step; of all cells,
// walls included, 95.5 % (the aim is 99.5 %, too: this bound only ever rises).
TEST(HardTileBorders, neighbours_agree_on_what_both_compute) {
  struct Count {
    int both = 0, agree = 0;
  } all, far_from_walls;
  for (const double place : kPlacesOfTheBorder) {
    const Neighbours n(place);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < 2 * kCollar; ++x) {
        const float za = n.a.height_m(x + kShift, y), zb = n.b.height_m(x, y);
        if (std::isnan(za) || std::isnan(zb)) continue;
        const bool is_equal = std::abs(za - zb) <= 0.5 * n.world.problem.dz_m;
        ++all.both, all.agree += is_equal;
        if (!n.is_level_around(x, y, 8)) continue;
        ++far_from_walls.both, far_from_walls.agree += is_equal;
      }
    }
  }
  ASSERT_GT(all.both, 7 * 2 * kCollar * kHeight * 95 / 100);
  ASSERT_GT(far_from_walls.both, 7000);
  EXPECT_GE(far_from_walls.agree, 0.995 * far_from_walls.both) << far_from_walls.agree << " of " << far_from_walls.both;
  EXPECT_GE(all.agree, 0.955 * all.both) << all.agree << " of " << all.both;
}

// Bound: within 16 columns of the border, of what the two tiles keep there, no more cells are off by a plane step than
// where the same columns are the middle of a tile, plus half a per cent.
TEST(HardTileBorders, errors_are_no_more_frequent_beside_a_border_than_inside) {
  constexpr int kBeside = 16;
  int cells = 0, off_at_border = 0, off_inside = 0;
  for (const double place : kPlacesOfTheBorder) {
    const Neighbours n(place);
    for (int y = 0; y < kHeight; ++y) {
      for (int i = -kBeside; i < kBeside; ++i) {
        const int of_b = kCollar + i, of_a = of_b + kShift, inside = kWidth / 2 + i;
        const double truth = n.truth_at(n.world.problem.grid, of_b, y);
        const auto is_off = [&](float z) { return !(std::abs(z - truth) <= n.world.problem.dz_m); };
        ++cells;
        off_at_border += is_off(i < 0 ? n.a.height_m(of_a, y) : n.b.height_m(of_b, y));
        off_inside += is_off(n.over_the_border.height_m(inside, y));
      }
    }
  }
  EXPECT_LE(off_at_border, off_inside + 0.005 * cells) << "of " << cells << ", inside " << off_inside;
}

}  // namespace
}  // namespace skysweep::hard
