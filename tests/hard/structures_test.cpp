// SPDX-License-Identifier: Apache-2.0
// Hard cases of structure: what rises, hides and hangs over.
#include "hard/box_world.h"
#include "hard/sound_result.h"

namespace skysweep::hard {
namespace {

struct Region {
  Vec2d low, high;
  double z;
};

// Share of the region's cells that claim a height within the tolerance, and of those that claim a wrong one.
struct Shares {
  double right = 0, wrong = 0;
};
Shares shares(const sweep::SweepProblem& problem, const sweep::SweepResult& result, const Region& region,
              double tolerance_m) {
  int cells = 0, right = 0, wrong = 0;
  for (int y = 0; y < problem.grid.height; ++y) {
    for (int x = 0; x < problem.grid.width; ++x) {
      const Vec2d c = problem.grid.cell_center(x, y);
      if (c.x < region.low.x || c.x > region.high.x || c.y < region.low.y || c.y > region.high.y) continue;
      ++cells;
      const float z = result.height_m(x, y);
      right += std::abs(z - region.z) <= tolerance_m;
      wrong += std::abs(z - region.z) > tolerance_m;
    }
  }
  EXPECT_GT(cells, 0);
  return {static_cast<double>(right) / cells, static_cast<double>(wrong) / cells};
}

// Hard: the tower covers half a photograph's height of parallax: 480 planes between neighbouring cells, its walls fill
// what the photographs show of the yard, and penalties for steps would rather spread the roof.
// Bound: roof, street and yard floor are found, the roof where it stands to two cells.
TEST(HardStructures, tower_of_120_m_beside_a_courtyard) {
  BoxWorld world;
  world.gsd_m = 0.25;
  world.boxes = {{{4, -6, 0}, {14, 6, 120}},    // the tower
                 {{-14, -8, 0}, {-12, 8, 20}},  // four wings around the yard
                 {{-2, -8, 0}, {0, 8, 20}},
                 {{-14, 6, 0}, {0, 8, 20}},
                 {{-14, -8, 0}, {0, -6, 20}}};
  WorldProblem p(world);
  for (int i = 0; i < 9; ++i)
    p.add_view(test::small_camera(1000, 640, 480), {camera::rotation_from_yaw_pitch_roll(40.0 * i, -90, 0),
                                                    {(i % 3 - 1) * 32.0 - 5, (i / 3 - 1) * 24.0, 250}});
  p.set_grid(128, 0.25, 0.5, -2, 124);
  const auto result = sweep_soundly(p.problem);
  const Shares roof = shares(p.problem, result, {{4.5, -5.5}, {13.5, 5.5}, 120}, 0.5);
  const Shares yard = shares(p.problem, result, {{-10, -4}, {-4, 4}, 0}, 1);
  const Shares wings = shares(p.problem, result, {{-13.5, -7.5}, {-12.5, 7.5}, 20}, 1);
  const Shares street = shares(p.problem, result, {{1, 10}, {3, 15}, 0}, 1);
  EXPECT_GT(roof.right, 0.95);
  EXPECT_GT(yard.right, 0.9) << yard.wrong;
  EXPECT_GT(wings.right, 0.9) << wings.wrong;
  EXPECT_GT(street.right, 0.9) << street.wrong;
}

// Hard: two surfaces above each other, both well textured and both seen by some views: each has a good match.
// Bound: the map holds the upper one, as its truth does; the ground beside it stays where it is.
TEST(HardStructures, bridge) {
  BoxWorld world;
  world.boxes = {{{-40, -2, 5.5}, {40, 2, 6.5}}};  // open below
  WorldProblem p(world);
  p.add_ring(8, test::small_camera(), 8, 35);
  p.set_grid(128, 0.1, 0.1, -1, 8);
  p.match_levels();
  const auto result = sweep_soundly(p.problem);
  const Shares deck = shares(p.problem, result, {{-6, -1.7}, {6, 1.7}, 6.5}, 0.2);
  const Shares beside = shares(p.problem, result, {{-6, 3}, {6, 6}, 0}, 0.2);
  EXPECT_GT(deck.right, 0.97) << deck.wrong;
  EXPECT_GT(beside.right, 0.95) << beside.wrong;
}

// Hard: a cap on a thin stem: all around its edge the ground goes on below it, and oblique views see it there.
// Bound: cap and ground as above.
TEST(HardStructures, mushroom) {
  BoxWorld world;
  world.boxes = {{{-0.3, -0.3, 0}, {0.3, 0.3, 4}}, {{-2.5, -2.5, 4}, {2.5, 2.5, 4.6}}};
  WorldProblem p(world);
  p.add_ring(8, test::small_camera(), 8, 33);
  p.set_grid(128, 0.1, 0.1, -1, 6);
  p.match_levels();
  const auto result = sweep_soundly(p.problem);
  const Shares cap = shares(p.problem, result, {{-2.2, -2.2}, {2.2, 2.2}, 4.6}, 0.2);
  const Shares beside = shares(p.problem, result, {{-6, 4}, {6, 6}, 0}, 0.2);
  EXPECT_GT(cap.right, 0.97) << cap.wrong;
  EXPECT_GT(beside.right, 0.95) << beside.wrong;
}

}  // namespace
}  // namespace skysweep::hard
