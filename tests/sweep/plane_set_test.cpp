// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_set.h"

#include <gtest/gtest.h>

namespace skysweep::sweep {
namespace {

using Ranges = std::vector<PlaneRange>;

TEST(PlaneSet, ranges_stay_apart_ascending_and_merge_where_they_meet) {
  PlaneSet planes = PlaneRange{10, 12};
  planes.include(PlaneRange{-3, 1});
  planes.include(PlaneRange{20, 25});
  EXPECT_EQ(planes.ranges(), (Ranges{{-3, 1}, {10, 12}, {20, 25}}));
  EXPECT_EQ(planes.count(), 5 + 3 + 6);
  EXPECT_EQ(planes.hull(), (PlaneRange{-3, 25}));
  planes.include(PlaneRange{2, 4});  // touches the first
  EXPECT_EQ(planes.ranges().front(), (PlaneRange{-3, 4}));
  planes.include(PlaneRange{11, 21});
  EXPECT_EQ(planes.ranges(), (Ranges{{-3, 4}, {10, 25}}));
  planes.include(PlaneRange{12, 13});  // there already
  planes.include(PlaneRange{});
  EXPECT_EQ(planes.count(), 8 + 16);
}

TEST(PlaneSet, contains_planes_and_ranges_within_one_of_its_own) {
  PlaneSet planes = PlaneRange{0, 4};
  planes.include(PlaneRange{8, 9});
  EXPECT_TRUE(planes.contains(4));
  EXPECT_FALSE(planes.contains(5));
  EXPECT_TRUE(planes.contains(PlaneRange{1, 3}));
  EXPECT_FALSE(planes.contains(PlaneRange{3, 8}));
}

TEST(PlaneSet, bridges_small_gaps_only) {
  PlaneSet planes = PlaneRange{0, 4};
  planes.include(PlaneRange{8, 9});
  planes.include(PlaneRange{14, 15});
  planes.bridge(3);
  EXPECT_EQ(planes.ranges(), (Ranges{{0, 9}, {14, 15}}));
}

TEST(PlaneSet, is_clipped) {
  PlaneSet planes = PlaneRange{0, 4};
  planes.include(PlaneRange{8, 9});
  planes.include(PlaneRange{14, 20});
  planes.clip({3, 15});
  EXPECT_EQ(planes.ranges(), (Ranges{{3, 4}, {8, 9}, {14, 15}}));
  planes.clip({5, 7});
  EXPECT_TRUE(planes.empty());
  EXPECT_EQ(planes.hull(), PlaneRange{});
}

}  // namespace
}  // namespace skysweep::sweep
