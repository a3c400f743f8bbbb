// SPDX-License-Identifier: Apache-2.0
// Hard cases of the matching costs: ties, limits, and numbers at the edge of what the machine has.
#include "hard/box_world.h"
#include "hard/sound_result.h"
#include "sweep/backend.h"
#include "sweep/cost_volume.h"
#include "sweep/heights.h"
#include "sweep/match_result.h"
#include "sweep/smoothing.h"

namespace skysweep::hard {
namespace {

// Hard: the same cost at every plane leaves the choice to the order in which planes and threads come.
// Bound: the lowest plane, in both backends, with and without smoothing, bit for bit for any number of threads; and no
// height is made of it.
TEST(HardCosts, ties_go_to_the_lowest_plane_everywhere) {
  for (const sweep::Smoothing smoothing : {sweep::Smoothing::none, sweep::Smoothing::semi_global}) {
    WorldProblem p({});
    p.problem.options.smoothing = smoothing;
    p.add_ring(4, test::small_camera(), 3, 30, [](Vec3d) { return 77.0; });
    p.set_grid(64, 0.1, 0.1, -1.05, 1);
    const int lowest = p.problem.planes_at(0, 0).hull().first;
    SerialExecutor serial;
    ThreadExecutor threads(3);
    for (const sweep::Backend backend : {sweep::Backend::cpu, sweep::Backend::reference}) {
      const auto one = sweep::match_planes(p.problem, backend, serial);
      const auto three = sweep::match_planes(p.problem, backend, threads);
      EXPECT_TRUE(same_bits(one.plane, three.plane) && same_bits(one.cost, three.cost));
      for (const int plane : one.plane) ASSERT_EQ(plane, lowest) << sweep::to_string(backend);
      for (const float z : sweep::heights_from_matches(p.problem, one).height_m) ASSERT_TRUE(std::isnan(z));
    }
  }
}

// Hard: of several views with the same C_k more than half may be tied at the limit of the consensus.
// Bound: the fast backend and the reference take the same ones: costs agree to a thousandth of a grey level.
TEST(HardCosts, ties_among_the_views_of_the_consensus) {
  WorldProblem p({});
  p.problem.options.smoothing = sweep::Smoothing::none;
  p.problem.options.normalization_radius_px = 0;
  // Pairs of views that show exactly the same grey: two black, two white, two grey.
  int i = 0;
  const Mat3d down = camera::rotation_from_yaw_pitch_roll(0, -90, 0);
  for (const double grey : {0.0, 0.0, 255.0, 255.0, 128.0, 128.0}) {
    p.add_view(test::small_camera(), {down, {i - 3.0, 0.5 * i, 30}}, [grey](Vec3d) { return grey; });
    ++i;
  }
  p.set_grid(64, 0.1, 0.1, -1, 1);
  SerialExecutor serial;
  for (const auto aggregation :
       {sweep::Aggregation::all_views, sweep::Aggregation::better_half, sweep::Aggregation::consensus}) {
    p.problem.options.aggregation = aggregation;
    const auto cpu = sweep::match_planes(p.problem, sweep::Backend::cpu, serial);
    const auto reference = sweep::match_planes(p.problem, sweep::Backend::reference, serial);
    for (std::size_t k = 0; k < cpu.cost.size(); ++k) {
      ASSERT_TRUE(std::isfinite(reference.cost.data()[k]));
      ASSERT_NEAR(cpu.cost.data()[k], reference.cost.data()[k], 1e-3);
    }
  }
}

// Hard: eight paths at their limit, one above the other. Bound: sums never wrap round to a low cost.
TEST(HardCosts, sums_of_the_worst_costs_do_not_overflow) {
  WorldProblem p({});
  p.problem.options.large_step_penalty = p.problem.options.small_step_penalty = 60;
  ASSERT_FALSE(p.problem.options.problem());
  p.set_grid(64, 0.1, 0.1, -1, 1);
  const sweep::CostVolume worst(p.problem, sweep::kWorstCost);
  for (const sweep::Backend backend : {sweep::Backend::cpu, sweep::Backend::reference}) {
    const sweep::CostVolume sums = sweep::smooth(p.problem, worst, backend);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        for (int k = 0; k < sums.planes_at(x, y).count(); ++k) ASSERT_GE(sums.cell(x, y)[k], sweep::kWorstCost);
  }
}

// Hard: costs beyond what the volume's whole numbers hold, and what is no number.
// Bound: the worst cost, never a wrapped one.
TEST(HardCosts, costs_that_are_no_numbers_are_the_worst) {
  EXPECT_EQ(sweep::quantized_cost(std::numeric_limits<double>::infinity()), sweep::kWorstCost);
  EXPECT_EQ(sweep::quantized_cost(std::numeric_limits<double>::quiet_NaN()), sweep::kWorstCost);
  EXPECT_EQ(sweep::quantized_cost(1e300), sweep::kWorstCost);
  EXPECT_EQ(sweep::quantized_cost(std::numeric_limits<double>::denorm_min()), 0);
}

// Hard: a curve so flat that its second difference is a denormal number; the vertex divides by it.
// Bound: a vertex within half a plane or none at all.
TEST(HardCosts, parabolas_through_denormal_and_infinite_costs) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const auto& [below, middle, above] : {std::array{kTiny, 0.0, 0.0},
                                             {0.0, 0.0, kTiny},
                                             {kTiny, 0.0, kTiny},
                                             {1 + 0x1p-52, 1.0, 1.0},
                                             {1e308, 0.0, 1e308},
                                             {kInfinity, 1.0, 2.0},
                                             {0.0, 0.0, 0.0},
                                             {kInfinity, kInfinity, kInfinity}}) {
    const sweep::Parabola p = sweep::parabola_through(below, middle, above);
    if (std::isnan(p.bend)) {
      EXPECT_TRUE(std::isnan(p.vertex));
    } else {
      EXPECT_GT(p.bend, 0);
      EXPECT_LE(std::abs(p.vertex), 0.5);
    }
  }
}

// Hard: the number of views that show a cell changes from plane to plane. Bound: as for flat images, the share of the
// cost that only counts views is no evidence for a height (see images_test.cpp); here without smoothing.
TEST(HardCosts, views_that_come_and_go_make_no_height) {
  WorldProblem p({});
  p.problem.options.smoothing = sweep::Smoothing::none;
  for (int i = 0; i < 9; ++i) {  // all look at the origin: nowhere else is as much seen
    const Vec3d from{20 * std::cos(0.7 * i), 20 * std::sin(0.7 * i), 30};
    p.add_view(test::small_camera(900), looking_at(from, {0, 0, 0}), [](Vec3d) { return 128.0; });
  }
  p.set_grid(128, 0.1, 0.5, -10, 10);
  const auto result = sweep_soundly(p.problem);
  const auto known =
      std::count_if(result.height_m.begin(), result.height_m.end(), [](float z) { return !std::isnan(z); });
  EXPECT_EQ(known, 0);
}

}  // namespace
}  // namespace skysweep::hard
