// SPDX-License-Identifier: Apache-2.0
#include "core/array2d.h"

#include <gtest/gtest.h>

namespace skysweep {
namespace {

// Each value tells its own place.
Array2d<int> numbered(int width, int height) {
  Array2d<int> a(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) a(x, y) = 100 * y + x;
  return a;
}

TEST(Array2d, lies_row_after_row_in_memory) {
  const Array2d<int> a = numbered(3, 2);
  EXPECT_EQ(std::vector<int>(a.begin(), a.end()), (std::vector<int>{0, 1, 2, 100, 101, 102}));
  EXPECT_EQ(a.row(1), a.data() + 3);
  EXPECT_EQ(a.row(1)[2], a(2, 1));
}

TEST(Array2d, is_filled_with_the_given_value) {
  const Array2d<float> a(4, 5, 2.5f);
  EXPECT_EQ(a.size(), 20u);
  for (const float v : a) EXPECT_EQ(v, 2.5f);
}

TEST(Array2d, contains_exactly_its_own_cells) {
  const Array2d<int> a(3, 2);
  EXPECT_TRUE(a.contains(0, 0));
  EXPECT_TRUE(a.contains(2, 1));
  EXPECT_FALSE(a.contains(3, 1));
  EXPECT_FALSE(a.contains(2, 2));
  EXPECT_FALSE(a.contains(-1, 0));
  EXPECT_FALSE(a.contains(0, -1));
}

TEST(Array2d, default_is_empty_and_one_without_rows_too) {
  EXPECT_TRUE(Array2d<int>().empty());
  EXPECT_TRUE(Array2d<int>(7, 0).empty());
  EXPECT_EQ(Array2d<int>(7, 0).width(), 7);
}

TEST(Array2d, equality_sees_shape_as_well_as_values) {
  EXPECT_EQ(numbered(3, 2), numbered(3, 2));
  EXPECT_NE(Array2d<int>(3, 2), Array2d<int>(2, 3));
  Array2d<int> changed = numbered(3, 2);
  changed(1, 1) = -1;
  EXPECT_NE(changed, numbered(3, 2));
}

TEST(Array2d, crop_takes_the_named_window) {
  const Array2d<int> window = crop(numbered(10, 8), 3, 2, 4, 5);
  ASSERT_EQ(window.width(), 4);
  ASSERT_EQ(window.height(), 5);
  EXPECT_EQ(window(0, 0), 203);
  EXPECT_EQ(window(3, 4), 606);
  EXPECT_EQ(crop(numbered(10, 8), 0, 0, 10, 8), numbered(10, 8));
}

TEST(Array2dDeathTest, crop_outside_is_a_bug) { EXPECT_DEATH(crop(numbered(4, 4), 2, 2, 3, 1), "never be false"); }

}  // namespace
}  // namespace skysweep
