// SPDX-License-Identifier: Apache-2.0
#include "sweep/height_range.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

test::SyntheticProblem wide_search(const test::Surface& surface) {
  test::SyntheticProblem p = test::ring_of_views(6, test::small_camera(), surface);
  test::set_grid(p.problem, 192, 0.1, 0.12, 0, 0);
  return p;
}

TEST(CoarseSurface, finds_the_ground_in_everything_below_the_cameras) {
  test::SyntheticProblem p = wide_search([](double, double) { return 1.7; });
  SerialExecutor serial;
  const Array2d<float> surface = coarse_surface(p.problem, -15, 27, Backend::cpu, serial);
  EXPECT_EQ(surface.width(), 24);
  const std::optional<HeightRange> range = search_near(surface, p.problem);
  ASSERT_TRUE(range);
  const double coarse_step = kCoarseCells * p.problem.dz_m;
  EXPECT_NEAR(range->z_low, 1.7, 2 * coarse_step);
  EXPECT_NEAR(range->z_high, 1.7, 2 * coarse_step);
  for (const PlaneSet& found : p.problem.block_planes) {
    const PlaneRange planes = found.hull();
    EXPECT_LE(planes.first * 0.12, 1.7);
    EXPECT_GE(planes.last * 0.12, 1.7);
    EXPECT_LT(planes.count(), 100);
  }
}

TEST(CoarseSurface, blocks_search_near_their_own_surface) {
  SweepProblem problem;
  problem.grid = {384, 64, 0.1, {0, 0}};
  problem.dz_m = 0.1;
  Array2d<float> surface(48, 8, 2.0f);
  for (int y = 0; y < 8; ++y)
    for (int x = 44; x < 48; ++x) surface(x, y) = 12;
  const std::optional<HeightRange> whole = search_near(surface, problem);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->z_high, 12);
  const auto highest = [&](int block) { return problem.block_planes(block, 0).hull().last * 0.1; };
  EXPECT_LT(highest(0), 7) << "far from the step: the surface, six coarse planes of margin";
  EXPECT_LT(highest(11), 7);
  EXPECT_GT(highest(12), 12);
}

TEST(CoarseSurface, of_photographs_without_texture_is_empty_and_nothing_is_searched) {
  test::SyntheticProblem p = test::ring_of_views(4, test::small_camera(), [](double, double) { return 0.0; });
  std::deque<ImagePyramid> bare;
  for (View& view : p.problem.views) {
    bare.emplace_back(Array2d<Rgb8>(view.image->width(), view.image->height(), {90, 90, 90}));
    view.image = &bare.back();
  }
  test::set_grid(p.problem, 128, 0.1, 0.12, 0, 0);
  SerialExecutor serial;
  const Array2d<float> surface = coarse_surface(p.problem, -5, 20, Backend::cpu, serial);
  EXPECT_FALSE(search_near(surface, p.problem));
  EXPECT_TRUE(p.problem.all_planes().empty());
}

}  // namespace
}  // namespace skysweep::sweep
