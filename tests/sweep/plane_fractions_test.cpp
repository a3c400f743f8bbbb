// SPDX-License-Identifier: Apache-2.0
// Between planes, no place is more likely than another: what a tilted plane shows.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sweep/plane_sweep.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

TEST(PlaneFractions, of_a_tilted_plane_are_spread_evenly) {
  const auto tilted = [](double x, double y) { return 0.17 * x + 0.09 * y; };
  test::SyntheticProblem p = test::ring_of_views(7, test::small_camera(), tilted);
  test::set_grid(p.problem, 96, 0.1, 0.1, -2.5, 2.5);
  p.problem.grid.north_west_corner = p.problem.grid.north_west_corner + Vec2d{0.013, 0.021};  // no symmetry
  SerialExecutor serial;
  const SweepResult result = plane_sweep(p.problem, Backend::cpu, serial);
  // A cell counts for the tenth of a plane step in which it was found, and against the one in which it truly lies.
  constexpr int kBins = 10;
  std::array<int, kBins> found{}, truly{};
  const auto bin = [&](double z) {
    const double planes = z / p.problem.dz_m;
    return std::min(kBins - 1, static_cast<int>(kBins * (planes - std::floor(planes))));
  };
  int known = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (std::isnan(result.height_m(x, y))) continue;
      const Vec2d cell = p.problem.grid.cell_center(x, y);
      ++known, ++found[bin(result.height_m(x, y))], ++truly[bin(tilted(cell.x, cell.y))];
    }
  }
  ASSERT_GT(known, 9000);
  for (int i = 0; i < kBins; ++i) {
    EXPECT_NEAR(truly[i], 0.1 * known, 0.002 * known) << "the scene itself";
    EXPECT_NEAR(found[i], 0.1 * known, 0.005 * known) << "tenth " << i;
  }
}

}  // namespace
}  // namespace skysweep::sweep
