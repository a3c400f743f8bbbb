// SPDX-License-Identifier: Apache-2.0
#include "tiles/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace skysweep::tiles {
namespace {

// Cells whose tile size is exact in binary, and such as are not.
const Lattice kLattices[] = {{512, 1, 1}, {512, 0.1, 0.05}, {256, 0.03, 0.01}, {64, 0.7, 1}};

TEST(Lattice, is_anchored_at_the_origin_and_grows_to_the_north_east) {
  const Lattice lattice{512, 0.1, 0.05};
  EXPECT_EQ(lattice.south_west_corner({0, 0, 0}), (Vec2d{0, 0}));
  EXPECT_EQ(lattice.key_at(0, {0, 0}), (TileKey{0, 0, 0}));
  EXPECT_EQ(lattice.key_at(0, {-1e-9, 51.3}), (TileKey{0, -1, 1}));
  EXPECT_EQ(lattice.key_at(3, {-1e-9, 51.3}), (TileKey{3, -1, 0}));
  EXPECT_NEAR(lattice.tile_size_m(2), 204.8, 1e-9);
}

TEST(Lattice, every_tile_owns_its_south_west_corner_wherever_it_is) {
  Random random(3);
  for (const Lattice& lattice : kLattices)
    for (int i = 0; i < 2000; ++i) {
      const TileKey key{random.below(8), random.below(200'000) - 100'000, random.below(200'000) - 100'000};
      const Vec2d corner = lattice.south_west_corner(key);
      EXPECT_EQ(lattice.key_at(key.level, corner), key);
      const Vec2d before{std::nextafter(corner.x, -1e18), std::nextafter(corner.y, -1e18)};
      EXPECT_EQ(lattice.key_at(key.level, before), (TileKey{key.level, key.x - 1, key.y - 1}));
    }
}

TEST(Lattice, neighbours_share_their_border_bit_for_bit_at_every_level) {
  for (const Lattice& lattice : kLattices)
    for (const TileKey key : {TileKey{0, -7, 4}, TileKey{2, 123'457, -98'765}, TileKey{5, -1, 0}}) {
      const Box2d extent = lattice.extent(key);
      EXPECT_EQ(extent.max, lattice.south_west_corner({key.level, key.x + 1, key.y + 1}));
      EXPECT_EQ(lattice.north_west_corner(key), (Vec2d{extent.min.x, extent.max.y}));
      // A parent's corner is its south-west child's.
      EXPECT_EQ(lattice.south_west_corner({key.level + 1, key.x, key.y}),
                lattice.south_west_corner({key.level, 2 * key.x, 2 * key.y}));
    }
}

TEST(LevelPlan, top_covers_at_most_two_by_two_tiles_and_all_of_them) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const int span = 1 << random.below(20);
    const int x0 = random.below(2'000'000) - 1'000'000, y0 = random.below(2'000'000) - 1'000'000;
    const int x1 = x0 + random.below(span), y1 = y0 + random.below(span);
    const LevelPlan plan = plan_levels(x0, y0, x1, y1);
    const int level = plan.highest_regular_level;
    EXPECT_EQ(plan.top_south_west, (TileKey{level, x0 >> level, y0 >> level}));
    EXPECT_LE((x1 >> level) - (x0 >> level), 1);
    EXPECT_LE((y1 >> level) - (y0 >> level), 1);
    if (level > 0) {
      EXPECT_TRUE((x1 >> (level - 1)) - (x0 >> (level - 1)) > 1 || (y1 >> (level - 1)) - (y0 >> (level - 1)) > 1)
          << "a lower level would have served";
    }
  }
}

TEST(LevelPlan, few_tiles_across_the_origin_need_no_level_between_them_and_the_top) {
  const LevelPlan plan = plan_levels(-1, -1, 0, 0);
  EXPECT_EQ(plan.highest_regular_level, 0);
  EXPECT_EQ(plan.level_count(), 2);
  EXPECT_EQ(plan.top_south_west, (TileKey{0, -1, -1}));
  EXPECT_EQ(plan_levels(-1, 0, 1, 0).highest_regular_level, 1);
}

}  // namespace
}  // namespace skysweep::tiles
