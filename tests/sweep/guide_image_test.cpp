// SPDX-License-Identifier: Apache-2.0
#include "sweep/guide_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hard/box_world.h"
#include "sweep/penalties.h"

namespace skysweep::sweep {
namespace {

constexpr int kCells = 48;
constexpr int kWest = 60, kEast = 180;  // grey levels of the ground on both sides of x = 0

// Level ground at `ground_z` that is dark in the west and bright in the east; cells and pixels of 0.1 m.
struct TwoTones : hard::WorldProblem {
  explicit TwoTones(double ground_z) : WorldProblem(hard::BoxWorld{.ground_z = ground_z}) {
    add_ring(6, test::small_camera(), 6, 30 + ground_z, [](Vec3d p) { return p.x < 0 ? kWest : kEast; });
    set_grid(kCells, 0.1, 0.25, -1, 3);
  }
};

MatchResult found_everywhere(int cells, int plane) {
  MatchResult result(cells, cells);
  for (int& k : result.plane) k = plane;
  for (float& cost : result.cost) cost = 1;
  return result;
}

void expect_both_tones(const Array2d<std::uint8_t>& guide) {
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      if (x < kCells / 2 - 1)
        EXPECT_NEAR(guide(x, y), kWest, 1) << x << ", " << y;
      else if (x > kCells / 2)
        EXPECT_NEAR(guide(x, y), kEast, 1) << x << ", " << y;
      else
        EXPECT_TRUE(guide(x, y) >= kWest && guide(x, y) <= kEast) << x << ", " << y;
    }
  }
}

TEST(GuideImage, shows_an_edge_of_the_ground_where_it_is) {
  const TwoTones world(1);
  SerialExecutor serial;
  expect_both_tones(guide_image(world.problem, found_everywhere(kCells, 4), 1, serial));
}

TEST(GuideImage, cells_and_planes_of_a_coarser_search_are_twice_as_large) {
  const TwoTones world(1);
  SerialExecutor serial;
  expect_both_tones(guide_image(world.problem, found_everywhere(kCells / 2, 2), 2, serial));
}

TEST(GuideImage, does_not_depend_on_the_number_of_threads) {
  const TwoTones world(0);
  SerialExecutor serial;
  ThreadExecutor threads(3);
  const MatchResult found = found_everywhere(kCells, 0);
  EXPECT_EQ(guide_image(world.problem, found, 1, serial), guide_image(world.problem, found, 1, threads));
}

TEST(GuideImage, is_0_where_nothing_was_found_and_only_there) {
  TwoTones world(0);
  MatchResult found = found_everywhere(kCells, 0);
  found.cost(7, 9) = std::numeric_limits<float>::infinity();
  SerialExecutor serial;
  Array2d<std::uint8_t> guide = guide_image(world.problem, found, 1, serial);
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) EXPECT_EQ(guide(x, y) == 0, x == 7 && y == 9) << x << ", " << y;
  world.problem.views.clear();
  guide = guide_image(world.problem, found, 1, serial);
  for (const std::uint8_t grey : guide) EXPECT_EQ(grey, 0);
}

// Penalties between (0, 0) and (1, 0) of a guide with these two grey levels.
class GuidedPenalties : public testing::Test {
 protected:
  GuidedPenalties() {
    problem_.grid = {2, 1, 1, {0, 0}};
    problem_.options.small_step_penalty = 1;
    problem_.options.large_step_penalty = 12;
    problem_.options.edge_contrast = 10;
  }

  double large(int from, int to) {  // grey levels of matching cost
    problem_.guide = Array2d<std::uint8_t>(2, 1);
    problem_.guide(0, 0) = static_cast<std::uint8_t>(from);
    problem_.guide(1, 0) = static_cast<std::uint8_t>(to);
    const Penalties penalties(problem_);
    EXPECT_EQ(penalties.large(0, 0, 1, 0), penalties.large(1, 0, 0, 0));
    EXPECT_EQ(penalties.large(), Cost{12} << 20);
    EXPECT_EQ(penalties.small(), std::lround(problem_.options.small_step_penalty * kCostScale));
    return penalties.large(0, 0, 1, 0) / kCostScale;
  }

  SweepProblem problem_;
};

TEST_F(GuidedPenalties, fall_in_proportion_with_the_difference_down_to_a_quarter) {
  EXPECT_EQ(large(100, 100), 12);
  EXPECT_EQ(large(100, 110), 12);
  EXPECT_NEAR(large(100, 115), 8, 1e-4);
  EXPECT_NEAR(large(120, 100), 6, 1e-4);
  EXPECT_NEAR(large(100, 140), 3, 1e-4);
  EXPECT_NEAR(large(1, 255), 3, 1e-4);
}

TEST_F(GuidedPenalties, never_fall_below_the_price_of_a_small_step) {
  problem_.options.small_step_penalty = 5;
  EXPECT_NEAR(large(120, 100), 6, 1e-4);
  EXPECT_EQ(large(140, 100), 5);
}

TEST_F(GuidedPenalties, stay_where_nothing_is_known) {
  EXPECT_EQ(large(0, 200), 12);
  EXPECT_EQ(large(200, 0), 12);
  problem_.guide = {};
  EXPECT_EQ(Penalties(problem_).large(0, 0, 1, 0), Cost{12} << 20);
}

TEST_F(GuidedPenalties, are_the_same_everywhere_without_contrast) {
  problem_.options.edge_contrast = 0;
  EXPECT_EQ(large(1, 255), 12);
}

TEST_F(GuidedPenalties, a_wrong_contrast_is_refused_with_a_sentence) {
  for (const double contrast : {-1., 256., std::numeric_limits<double>::quiet_NaN()}) {
    problem_.options.edge_contrast = contrast;
    EXPECT_EQ(problem_.options.problem().value_or(""), "edge_contrast must lie between 0 (off) and 255 grey levels");
  }
}

}  // namespace
}  // namespace skysweep::sweep
