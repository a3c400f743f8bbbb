// SPDX-License-Identifier: Apache-2.0
#include "tiles/virtual_mosaic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "tiles/pyramid.h"
#include "tiles/random_tile.h"

namespace skysweep::tiles {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

constexpr int kCells = 16;

class VirtualMosaic : public testing::Test {
 protected:
  VirtualMosaic()
      : store(folder / "tiles", Lattice{kCells, 0.1, 0.05}, raster::crs_from_user_input("EPSG:32632"), "EGM96 height",
              "skysweep <test> & co") {}

  void make(const std::vector<TileKey>& keys) {
    for (const TileKey key : keys) store.write(key, random_tile(key, kCells), key.name());
    finest = keys;
    parents = update_parents(store).written;
    std::erase_if(parents, [](TileKey key) { return key.is_top(); });
    write();
  }
  void write() const {
    write_virtual_mosaic(store, "dem", finest, parents, "d", folder / "dsm.vrt");
    write_virtual_mosaic(store, "color", finest, parents, "d", folder / "ortho.vrt");
  }

  TempFolder folder;
  TileStore store;
  std::vector<TileKey> finest, parents;
};

TEST_F(VirtualMosaic, holds_every_tile_in_its_place_and_nothing_between_them) {
  make({{0, -3, 2}, {0, -1, -1}});
  const raster::Raster<float> map = raster::read_float_raster(folder / "dsm.vrt");
  ASSERT_EQ(map.values.width(), 3 * kCells);
  ASSERT_EQ(map.values.height(), 4 * kCells);
  EXPECT_EQ(map.georeference.north_west_corner, store.lattice().north_west_corner({0, -3, 2}));
  EXPECT_TRUE(raster::same_crs(map.georeference.crs_wkt, store.crs_wkt()));
  EXPECT_EQ(map.labels.software, "skysweep <test> & co");
  const auto expect_tile = [&](TileKey key, int column, int row) {
    const Array2d<float> dem = store.read(key)->dem;
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x) {
        const float there = map.values(column + x, row + y);
        EXPECT_TRUE(there == dem(x, y) || (std::isnan(there) && std::isnan(dem(x, y))));
      }
  };
  expect_tile({0, -3, 2}, 0, 0);
  expect_tile({0, -1, -1}, 2 * kCells, 3 * kCells);
  EXPECT_TRUE(std::isnan(map.values(kCells + 1, kCells + 1)));
  const raster::Raster<Rgba8> ortho = raster::read_color_raster(folder / "ortho.vrt");
  EXPECT_EQ(ortho.values(3, 5), store.read({0, -3, 2})->color(3, 5));
  EXPECT_EQ(ortho.values(kCells + 1, kCells + 1).a, 0);
}

// The window of the level-0 tiles cuts through the parents at its borders.
TEST_F(VirtualMosaic, overviews_lie_cell_on_cell) {
  make({{0, -3, 1}, {0, 2, 1}, {0, 1, 4}, {0, 7, -2}});
  const raster::Raster<float> map = raster::read_float_raster(folder / "dsm.vrt");
  for (const int level : {1, 2}) {
    const raster::Raster<float> overview =
        raster::read_float_raster(folder / ("tiles/dem/l" + std::to_string(level) + ".vrt"));
    EXPECT_EQ(overview.georeference.north_west_corner, map.georeference.north_west_corner);
    EXPECT_EQ(overview.georeference.cell_m, map.georeference.cell_m * (1 << level));
    EXPECT_EQ(overview.values.width(), map.values.width() >> level);
    EXPECT_EQ(overview.values.height(), map.values.height() >> level);
    const Vec2d at = overview.georeference.cell_center(0, overview.values.height() / 2);
    const Vec2d corner = store.lattice().north_west_corner(store.lattice().key_at(level, at));
    const std::optional<Tile> there = store.read(store.lattice().key_at(level, at));
    const double cell = store.lattice().cell_size_m(level);
    const int x = static_cast<int>((at.x - corner.x) / cell), y = static_cast<int>((corner.y - at.y) / cell);
    const float expected = there ? there->dem(x, y) : std::numeric_limits<float>::quiet_NaN();
    const float actual = overview.values(0, overview.values.height() / 2);
    EXPECT_TRUE(actual == expected || (std::isnan(actual) && std::isnan(expected)));
  }
}

TEST_F(VirtualMosaic, files_that_would_not_change_are_left_alone) {
  make({{0, 0, 0}, {0, 3, 3}});
  const auto time = fs::last_write_time(folder / "dsm.vrt");
  const std::string text = file_bytes(folder / "dsm.vrt");
  write();
  EXPECT_EQ(fs::last_write_time(folder / "dsm.vrt"), time);
  make({{0, 0, 0}, {0, 3, 3}, {0, 4, 3}});
  EXPECT_NE(file_bytes(folder / "dsm.vrt"), text);
  EXPECT_EQ(text.find(folder.path().string()), std::string::npos) << "a project can be moved as a whole";
}

TEST_F(VirtualMosaic, overviews_of_levels_that_are_gone_are_removed) {
  make({{0, 0, 0}, {0, 9, 9}});
  EXPECT_TRUE(fs::exists(folder / "tiles/dem/l2.vrt"));
  finest = {{0, 0, 0}};
  parents.clear();
  write();
  EXPECT_FALSE(fs::exists(folder / "tiles/dem/l1.vrt"));
  EXPECT_FALSE(fs::exists(folder / "tiles/dem/l2.vrt"));
  EXPECT_EQ(raster::read_float_raster(folder / "dsm.vrt").values.width(), kCells);
  remove_virtual_mosaic(store, "dem", folder / "dsm.vrt");
  EXPECT_FALSE(fs::exists(folder / "dsm.vrt"));
}

TEST_F(VirtualMosaic, that_cannot_be_written_is_named) {
  make({{0, 0, 0}});
  EXPECT_NE(message_of<Error>([&] {
              write_virtual_mosaic(store, "dem", finest, {}, "d", "/proc/dsm.vrt");
            }).find("/proc/dsm.vrt"),
            std::string::npos);
}

}  // namespace
}  // namespace skysweep::tiles
