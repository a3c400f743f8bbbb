// SPDX-License-Identifier: Apache-2.0
#include "sweep/best_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "sweep/backend.h"
#include "sweep/smoothing.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

template <typename T>
bool same_bits(const Array2d<T>& a, const Array2d<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Blocks of one range and of two, of fewer planes than a vector and of more, and one without any.
test::SyntheticProblem patchwork() {
  test::SyntheticProblem p =
      test::ring_of_views(5, test::small_camera(), [](double x, double y) { return 0.5 * std::sin(x) + 0.3 * y; });
  test::set_grid(p.problem, 75, 0.1, 0.05, -2, 2);
  p.problem.options.refinement_radius_cells = 0;
  for (int by = 0; by < p.problem.block_planes.height(); ++by) {
    for (int bx = 0; bx < p.problem.block_planes.width(); ++bx) {
      PlaneSet planes = PlaneRange{-12 - 3 * bx, -10 + 7 * by};
      if ((bx + by) % 2 == 0) planes.include(PlaneRange{5 + 7 * by, 5 + 7 * by + bx});
      p.problem.block_planes(bx, by) = bx == 1 && by == 2 ? PlaneSet() : planes;
    }
  }
  return p;
}

TEST(BestPlanes, cpu_backend_finds_them_bit_for_bit_on_every_instruction_set) {
  const test::SyntheticProblem p = patchwork();
  SerialExecutor serial;
  const std::string in_use = cpu_instruction_set_in_use();
  for (const std::string& name : cpu_instruction_sets()) {
    use_cpu_instruction_set(name);
    const CostVolume costs = match_costs(p.problem, Backend::cpu, serial);
    const MatchResult expected = best_planes(costs, smooth(p.problem, costs, Backend::cpu));
    const MatchResult found = match_planes(p.problem, Backend::cpu, serial);
    EXPECT_TRUE(same_bits(found.plane, expected.plane)) << name;
    EXPECT_TRUE(same_bits(found.cost, expected.cost)) << name;
    EXPECT_TRUE(same_bits(found.mean_cost, expected.mean_cost)) << name;
    EXPECT_TRUE(same_bits(found.fraction, expected.fraction)) << name;
    EXPECT_TRUE(same_bits(found.bend, expected.bend)) << name;
    EXPECT_TRUE(same_bits(found.rival_plane, expected.rival_plane)) << name;
    EXPECT_TRUE(same_bits(found.rival_excess, expected.rival_excess)) << name;
  }
  use_cpu_instruction_set(in_use);
}

}  // namespace
}  // namespace skysweep::sweep
