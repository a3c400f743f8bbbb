// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_key.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"

namespace skysweep::tiles {
namespace {

constexpr int kExtreme = (1 << 28) - 1;

std::vector<TileKey> all_sorts_of_keys() {
  std::vector<TileKey> keys = {TileKey::top()};
  for (const int level : {0, 1, 3, 30, 62})
    for (const int x : {-kExtreme, -7, -1, 0, 1, 4, kExtreme})
      for (const int y : {-kExtreme, -1, 0, 12, kExtreme}) keys.push_back({level, x, y});
  return keys;
}

TEST(TileKey, prints_as_in_the_literature) {
  EXPECT_EQ((TileKey{3, -7, 4}).name(), "l3x-7y4");
  EXPECT_EQ(TileKey::top().name(), "top");
}

TEST(TileKey, every_name_parses_back_and_every_packing_unpacks) {
  for (const TileKey key : all_sorts_of_keys()) {
    EXPECT_EQ(TileKey::parse(key.name()), key) << key.name();
    EXPECT_EQ(TileKey::unpacked(key.packed()), key) << key.name();
  }
}

TEST(TileKey, packed_numbers_have_the_order_of_the_keys) {
  std::vector<TileKey> keys = all_sorts_of_keys();
  std::sort(keys.begin(), keys.end());
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end(), [](TileKey a, TileKey b) { return a.packed() < b.packed(); }));
}

TEST(TileKey, other_spellings_are_no_names) {
  for (const char* text : {"", "l", "l3", "l3x", "l3x1", "l3x1y", "l3x1y2 ", " l3x1y2", "l3x01y2", "l3x-0y2", "l3x+1y2",
                           "L3X1Y2", "l-1x0y0", "l63x0y0", "l64x0y0", "l3x1y2z", "l3x99999999999y2", "Top", "top "})
    EXPECT_FALSE(TileKey::parse(text)) << text;
}

TEST(TileKey, parent_covers_its_children_also_among_negatives) {
  EXPECT_EQ((TileKey{0, -1, -1}).parent(), (TileKey{1, -1, -1}));
  EXPECT_EQ((TileKey{0, -2, -3}).parent(), (TileKey{1, -1, -2}));
  EXPECT_EQ((TileKey{0, 3, 2}).parent(), (TileKey{1, 1, 1}));
  for (const TileKey key : {TileKey{2, -5, 3}, TileKey{1, 0, 0}, TileKey{4, -1, -1}})
    for (const int dx : {0, 1})
      for (const int dy : {0, 1}) EXPECT_EQ(key.child(dx, dy).parent(), key);
}

}  // namespace
}  // namespace skysweep::tiles
