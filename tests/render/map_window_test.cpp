// SPDX-License-Identifier: Apache-2.0
#include "render/map_window.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "tiles/pyramid.h"

namespace skysweep::render {
namespace {

using testing_support::TempFolder;
using tiles::TileKey;

constexpr int kCells = 32;

// 3 x 2 tiles of 0.5 m cells far from the origin; the outermost 5 cells in the west hold nothing, and tile (2, 1) is
// not there.
class MapWindowTest : public testing::Test {
 protected:
  static constexpr int kX = 600000, kY = -250000;

  MapWindowTest() : store(folder / "tiles", {kCells, 0.5, 0.1}, raster::local_metric_crs(), "unknown", "test") {
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 2; ++y)
        if (x != 2 || y != 1) store.write({0, kX + x, kY + y}, tile(x, y), "digest");
    tiles::update_parents(store);
  }

  // x, y: cells from the south-west corner.
  static float height(int x, int y) { return static_cast<float>(100 + 0.25 * x + 3 * y); }

  tiles::Tile tile(int column, int row) const {
    tiles::Tile t{Array2d<float>(kCells, kCells, std::nanf("")),
                  {},
                  Array2d<Rgba8>(kCells, kCells),
                  Array2d<float>(kCells, kCells, 0.1f),
                  Array2d<std::uint8_t>(kCells, kCells, 1)};
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x) {
        const int cx = column * kCells + x, cy = row * kCells + kCells - 1 - y;
        if (cx >= 5) t.dem(x, y) = height(cx, cy);
        t.color(x, y) = {static_cast<std::uint8_t>(cx), static_cast<std::uint8_t>(cy), 7, 255};
      }
    return t;
  }

  static Vec2d corner() { return {kX * kCells * 0.5, kY * kCells * 0.5}; }

  TempFolder folder;
  tiles::TileStore store;
};

TEST_F(MapWindowTest, tiles_join_without_seam_cut_to_what_is_known) {
  const MapWindow window = read_map_window(store, std::nullopt, 1 << 20);
  EXPECT_EQ(window.level, 0);
  EXPECT_EQ(window.height_m.width(), 3 * kCells - 5);
  EXPECT_EQ(window.height_m.height(), 2 * kCells);
  EXPECT_EQ(window.north_west_m, corner() + (Vec2d{5 * 0.5, 2 * kCells * 0.5}));
  for (int y = 0; y < 2 * kCells; ++y)
    for (int x = 0; x < window.height_m.width(); ++x) {
      const int cx = x + 5, cy = 2 * kCells - 1 - y;
      if (cx >= 2 * kCells && cy >= kCells) {
        ASSERT_TRUE(std::isnan(window.height_m(x, y)));
        continue;
      }
      ASSERT_EQ(window.height_m(x, y), height(cx, cy));
      ASSERT_EQ(window.color(x, y).r, cx);
      ASSERT_EQ(window.color(x, y).g, cy);
    }
}

TEST_F(MapWindowTest, an_area_cuts_cells_out) {
  const Vec2d sw = corner();
  const MapWindow window = read_map_window(store, Box2d{{sw.x + 10, sw.y + 4}, {sw.x + 20, sw.y + 9}}, 1 << 20);
  EXPECT_EQ(window.height_m.width(), 20);
  EXPECT_EQ(window.height_m.height(), 10);
  EXPECT_EQ(window.height_m(0, 9), height(20, 8));
  EXPECT_THROW(read_map_window(store, Box2d{{0, 0}, {1, 1}}, 1 << 20), Error);
}

TEST_F(MapWindowTest, what_does_not_fit_comes_at_a_coarser_level) {
  const MapWindow window = read_map_window(store, std::nullopt, 5 * kCells * kCells);
  EXPECT_EQ(window.level, 1);
  EXPECT_EQ(window.cell_m, 1);
  EXPECT_NEAR(window.height_m(10, window.height_m.height() - 1),
              0.25 * (height(24, 0) + height(25, 0) + height(24, 1) + height(25, 1)), 1e-4);
  try {
    read_map_window(store, std::nullopt, 10);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::memory_plan);
  }
}

}  // namespace
}  // namespace skysweep::render
