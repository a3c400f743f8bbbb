// SPDX-License-Identifier: Apache-2.0
// Law: the scene moved by any whole number of level-0 tiles gives the same heights and colours at level 0, bit for bit.
#include <cstring>

#include "laws/small_flight.h"

namespace skysweep::laws {
namespace {

// How many whole tiles of 64 cells of 0.1 m the scene is moved by, and how far that is.
struct Shift {
  const char* name;
  int tiles_x, tiles_y;
  double x_m, y_m;
};

std::ostream& operator<<(std::ostream& out, const Shift& shift) { return out << shift.name; }

template <typename T>
bool same_bits(const Array2d<T>& a, const Array2d<T>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

class TranslationLaw : public SmallFlight, public testing::WithParamInterface<Shift> {};

TEST_P(TranslationLaw, moved_by_whole_tiles_gives_the_same_tiles) {
  const Shift shift = GetParam();
  const pipeline::RunRequest here = request("here");
  pipeline::RunRequest there = request("there");
  there.origin = {shift.x_m, shift.y_m, 0};
  const pipeline::RunSummary summary = run(here), moved = run(there);
  EXPECT_EQ(summary.settings.lattice, moved.settings.lattice);

  const tiles::TileStore tiles = store(here), moved_tiles = store(there);
  const std::vector<tiles::TileKey> keys = tiles.list(0);
  ASSERT_GE(keys.size(), 6u);
  EXPECT_EQ(moved_tiles.list(0).size(), keys.size());
  for (const tiles::TileKey key : keys) {
    SCOPED_TRACE(key.name());
    const auto a = tiles.read(key);
    const auto b = moved_tiles.read({0, key.x + shift.tiles_x, key.y + shift.tiles_y});
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(same_bits(a->dem, b->dem));
    EXPECT_TRUE(same_bits(a->confidence, b->confidence));
    EXPECT_TRUE(same_bits(a->color, b->color));
    EXPECT_TRUE(same_bits(a->mask, b->mask));
  }
}

INSTANTIATE_TEST_SUITE_P(Shifts, TranslationLaw,
                         testing::Values(Shift{"utm", 108000, 833440, 691200.0, 5334016.0},
                                         Shift{"negative", -56, -63, -358.4, -403.2},
                                         Shift{"one_tile_west", -1, 0, -6.4, 0},
                                         Shift{"ten_thousand_kilometres", 1562496, -1562496, 9999974.4, -9999974.4}),
                         [](const auto& shift) { return std::string(shift.param.name); });

}  // namespace
}  // namespace skysweep::laws
