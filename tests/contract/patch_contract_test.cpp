// SPDX-License-Identifier: Apache-2.0
// The costs of patches (zncc, census): the cpu on every instruction set must find what the scalar double-precision
// reference finds. Costs within 5e-3 grey levels on 99.9 % of the cells and planes (those that the reference has and,
// where a view's border runs through a patch, those that it has not); heights within 2e-3 of a plane step on 99.9 % of
// the cells. The gpu leaves patches to the cpu, and says so.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <memory>

#include "core/executor.h"
#include "sweep/backend.h"
#include "sweep/heights.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }

// `views` small photographs of rolling ground: 40 x 24 cells, a block and a half high.
test::SyntheticProblem small(int views, double focal_px = 150) {
  test::SyntheticProblem p = test::ring_of_views(views, test::small_camera(focal_px, 120, 90), rolling);
  test::set_grid(p.problem, 40, 0.2, 0.25, -1.5, 1.5);
  p.problem.grid.height = 24;
  p.problem.search_everywhere(planes_between(-1.5, 1.5, 0.25, 0));
  p.problem.options.normalization_radius_px = 0;
  return p;
}

struct MadeCase {
  std::string name;
  test::SyntheticProblem made;
};

std::deque<MadeCase> make_cases() {
  std::deque<MadeCase> all;  // problems point into it: nothing moves
  all.push_back({"six_views", small(6)});
  all.push_back({"borders_of_photographs", small(5, 250)});
  all.push_back({"radius_1", small(4)});
  all.back().made.problem.options.patch_radius_cells = 1;
  all.push_back({"all_views", small(5)});
  all.back().made.problem.options.aggregation = Aggregation::all_views;
  all.push_back({"better_half", small(5)});
  all.back().made.problem.options.aggregation = Aggregation::better_half;
  all.push_back({"coarser_windows", small(4)});
  all.back().made.problem.options.window_level_min = 1;
  all.back().made.problem.options.window_level_max = 2;
  all.push_back({"two_ranges_and_an_empty_block", small(4)});
  PlaneSet apart = PlaneRange{-5, -2};
  apart.include(PlaneRange{2, 6});
  all.back().made.problem.block_planes(1, 0) = apart;
  all.back().made.problem.block_planes(0, 1) = {};
  all.push_back({"views_hidden_behind_a_wall", small(5)});
  SweepProblem& hidden = all.back().made.problem;
  Array2d<float> surface(40, 24, std::numeric_limits<float>::quiet_NaN());
  for (int y = 4; y < 20; ++y)
    for (int x = 15; x < 22; ++x) surface(x, y) = 2.5f;
  const Array2d<std::uint8_t> everywhere(40, 24, 1);
  SerialExecutor serial;
  hidden.visibility = {std::make_shared<const Horizons>(hidden.grid, hidden.views,
                                                        HorizonQuestion{surface, everywhere, -2, 0.1, 0}, serial),
                       1, 0};
  hidden.options.min_views = 3;
  return all;
}

struct PatchCase {
  std::string name;
  SweepProblem problem;
};

std::vector<PatchCase> cases(MatchingCost cost) {
  static const std::deque<MadeCase> made = make_cases();  // the photographs stay
  std::vector<PatchCase> all;
  for (const MadeCase& c : made) {
    all.push_back({c.name, c.made.problem});
    all.back().problem.options.cost = cost;
  }
  return all;
}

class PatchContract : public testing::TestWithParam<MatchingCost> {
 protected:
  void TearDown() override { use_cpu_instruction_set(cpu_instruction_sets().front()); }
  SerialExecutor serial_;
};

TEST_P(PatchContract, costs) {
  for (const PatchCase& c : cases(GetParam())) {
    c.problem.check();
    const CostVolume expected = match_costs(c.problem, Backend::reference, serial_);
    for (const std::string& name : cpu_instruction_sets()) {
      use_cpu_instruction_set(name);
      const CostVolume actual = match_costs(c.problem, Backend::cpu, serial_);
      std::size_t bad = 0, values = 0, known = 0;
      for (int y = 0; y < expected.height(); ++y)
        for (int x = 0; x < expected.width(); ++x)
          for (int i = 0; i < CostVolume::padded_planes(expected.planes_at(x, y)); ++i, ++values) {
            bad += std::abs(expected.cell(x, y)[i] - actual.cell(x, y)[i]) > 5e-3 * kCostScale;
            known += expected.cell(x, y)[i] < kWorstCost;
          }
      EXPECT_LE(bad, values / 1000) << c.name << " on " << name << " of " << values;
      EXPECT_GT(known, values / 8) << c.name;
    }
  }
}

TEST_P(PatchContract, heights_cell_by_cell) {
  for (const PatchCase& c : cases(GetParam())) {
    const MatchResult reference = match_cell_by_cell(c.problem, Backend::reference, serial_);
    const Heights expected = heights_from_matches(c.problem, reference);
    for (const std::string& name : cpu_instruction_sets()) {
      use_cpu_instruction_set(name);
      const MatchResult matches = match_cell_by_cell(c.problem, Backend::cpu, serial_);
      const Heights actual = heights_from_matches(c.problem, matches);
      std::size_t bad = 0;
      for (std::size_t i = 0; i < expected.height_m.size(); ++i) {
        const float a = expected.height_m.data()[i], b = actual.height_m.data()[i];
        bad += std::isnan(a) != std::isnan(b) || std::abs(a - b) > 2e-3 * c.problem.dz_m;
      }
      EXPECT_LE(bad, expected.height_m.size() / 1000 + 1) << c.name << " on " << name;
    }
  }
}

TEST_P(PatchContract, threads_change_nothing) {
  const PatchCase c = cases(GetParam()).front();
  ThreadExecutor threads(3);
  EXPECT_TRUE(match_costs(c.problem, Backend::cpu, serial_) == match_costs(c.problem, Backend::cpu, threads));
}

// With or without a device.
TEST_P(PatchContract, the_gpu_leaves_patches_to_the_cpu_and_says_so) {
  const PatchCase c = cases(GetParam()).front();
  EXPECT_TRUE(why_not_on_gpu(c.problem.options));
  EXPECT_FALSE(why_not_on_gpu(SweepOptions()));
  std::vector<std::string> said;
  listen_to_gpu_trouble([&said](const std::string& sentence) { said.push_back(sentence); });
  const CostVolume costs = match_costs(c.problem, Backend::gpu, serial_);
  listen_to_gpu_trouble(nullptr);
  EXPECT_TRUE(costs == match_costs(c.problem, Backend::cpu, serial_));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said.front().find("sad"), std::string::npos) << said.front();
}

INSTANTIATE_TEST_SUITE_P(OfPatches, PatchContract, testing::Values(MatchingCost::zncc, MatchingCost::census),
                         [](const auto& p) { return std::string(p.param == MatchingCost::zncc ? "zncc" : "census"); });

}  // namespace
}  // namespace skysweep::sweep
