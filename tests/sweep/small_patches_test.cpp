// SPDX-License-Identifier: Apache-2.0
#include "sweep/small_patches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skysweep::sweep {
namespace {

const float kNaN = std::nanf("");

int known(const Array2d<float>& height_m) {
  int count = 0;
  for (const float z : height_m) count += !std::isnan(z);
  return count;
}

// A plain of 10 x 10 cells at 0 with a block of `width` x `height` cells at z.
Array2d<float> plain_with_block(int width, int height, float z) {
  Array2d<float> surface(10, 10, 0.0f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) surface(3 + x, 4 + y) = z;
  return surface;
}

TEST(SmallPatches, of_fewer_cells_than_asked_are_taken_out_and_larger_ones_stay) {
  const Array2d<float> surface = plain_with_block(3, 2, 5);
  EXPECT_EQ(known(without_small_patches(surface, 1, 6)), 100);
  const Array2d<float> out = without_small_patches(surface, 1, 7);
  EXPECT_EQ(known(out), 94);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) EXPECT_EQ(std::isnan(out(x, y)), surface(x, y) == 5);
}

TEST(SmallPatches, end_where_neighbours_differ_by_more_than_the_agreement) {
  EXPECT_EQ(known(without_small_patches(plain_with_block(2, 2, 1), 1, 100)), 100);  // one patch with the plain
  EXPECT_EQ(known(without_small_patches(plain_with_block(2, 2, 1.01f), 1, 50)), 96);
}

TEST(SmallPatches, hang_together_along_a_slope_of_any_height) {
  Array2d<float> slope(30, 2);
  for (int x = 0; x < 30; ++x) slope(x, 0) = slope(x, 1) = 0.9f * static_cast<float>(x);
  EXPECT_EQ(known(without_small_patches(slope, 1, 60)), 60);
}

TEST(SmallPatches, do_not_reach_over_corners_or_unknown_cells) {
  Array2d<float> surface(5, 5, kNaN);
  surface(1, 1) = surface(2, 2) = surface(0, 3) = surface(4, 4) = 7;
  int patches = 0;
  for_each_small_patch(surface, 1, 2, [&](const Patch& patch) {
    ++patches;
    EXPECT_EQ(patch.size(), 1u);
  });
  EXPECT_EQ(patches, 4);
}

}  // namespace
}  // namespace skysweep::sweep
