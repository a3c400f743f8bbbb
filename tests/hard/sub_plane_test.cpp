// SPDX-License-Identifier: Apache-2.0
// Hard case: level ground between two planes. A cost curve that is pointed like a V is no parabola, and the vertex of
// one is pulled towards the nearest plane.
#include "hard/box_world.h"
#include "hard/sound_result.h"

namespace skysweep::hard {
namespace {

class HardSubPlane : public testing::TestWithParam<int> {};

// Bound: the mean height over the flat scene is off by less than 1/20 of a plane at every twentieth between two planes.
TEST_P(HardSubPlane, bias_of_a_flat_scene_stays_below_a_twentieth_of_a_plane) {
  constexpr double kDz = 0.1;
  BoxWorld world;
  world.ground_z = kDz * GetParam() / 20;
  WorldProblem p(world);
  p.add_ring(6, test::small_camera(), 6, 30);
  p.set_grid(64, 0.1, kDz, -1, 1);
  const auto result = sweep_soundly(p.problem);
  double sum = 0;
  int known = 0;
  for (const float z : result.height_m) {
    if (std::isnan(z)) continue;
    sum += z - world.ground_z;
    ++known;
  }
  ASSERT_GT(known, 64 * 64 * 98 / 100);
  EXPECT_LT(std::abs(sum / known), kDz / 20) << "bias " << sum / known / kDz << " planes";
}

INSTANTIATE_TEST_SUITE_P(TwentiethsOfAPlane, HardSubPlane, testing::Values(0, 2, 4, 5, 6, 8, 10, 12, 14, 15, 16, 18));

}  // namespace
}  // namespace skysweep::hard
