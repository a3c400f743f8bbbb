// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_store.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "tiles/random_tile.h"

namespace skysweep::tiles {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

constexpr int kCells = 16;
const Lattice kLattice{kCells, 0.1, 0.05};

TileStore store_in(const TempFolder& folder) {
  return {folder / "tiles", kLattice, raster::local_metric_crs(), "EGM96 height", "skysweep test"};
}

bool same_bits(const Array2d<float>& a, const Array2d<float>& b) {
  return a.size() == b.size() && (a.empty() || !std::memcmp(a.data(), b.data(), a.size() * sizeof(float)));
}

bool same(const Tile& a, const Tile& b) {
  return same_bits(a.dem, b.dem) && same_bits(a.dem_max, b.dem_max) && same_bits(a.confidence, b.confidence) &&
         a.color == b.color && a.mask == b.mask;
}

TEST(TileStore, tile_comes_back_as_it_was_written) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  for (const TileKey key : {TileKey{0, 3, 4}, TileKey{0, -7, 4}, TileKey{2, -1, -1}}) {
    Tile tile = random_tile(key, kCells);
    if (key.level > 0) tile.dem_max = tile.dem;
    store.write(key, tile, "digest of " + key.name());
    EXPECT_TRUE(same(store.read(key).value(), tile));
    EXPECT_EQ(store.input_digest(key), "digest of " + key.name());
  }
}

TEST(TileStore, files_lie_where_people_look_for_them_and_say_what_they_are) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const TileKey key{0, -7, 4};
  store.write(key, random_tile(key, kCells), "d");
  const raster::Raster<float> dem = raster::read_float_raster(folder / "tiles/dem/l0/x-7/y4.tif");
  EXPECT_EQ(dem.georeference.north_west_corner, kLattice.north_west_corner(key));
  EXPECT_EQ(dem.labels.vertical_reference, "EGM96 height");
  EXPECT_EQ(dem.labels.units, "metre");
  EXPECT_TRUE(fs::exists(folder / "tiles/color/l0/x-7/y4.tif"));
  EXPECT_FALSE(fs::exists(folder / "tiles/dem_max/l0/x-7/y4.tif"));
}

TEST(TileStore, top_is_placed_over_two_by_two_tiles) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  Tile tile = random_tile({0, 0, 0}, kCells);
  tile.dem_max = tile.dem;
  const LevelPlan plan = plan_levels(-3, -1, -1, 0);
  ASSERT_EQ(plan.highest_regular_level, 1);
  store.write(TileKey::top(), tile, "d", &plan);
  const raster::Raster<float> dem = raster::read_float_raster(folder / "tiles/dem/top.tif");
  EXPECT_EQ(dem.georeference.cell_m, 0.1 * 4);
  EXPECT_EQ(dem.georeference.north_west_corner.x, kLattice.south_west_corner({1, -2, 0}).x);
  EXPECT_EQ(dem.georeference.north_west_corner.y, kLattice.south_west_corner({1, -2, 1}).y);
  EXPECT_TRUE(same(store.read(TileKey::top()).value(), tile));
}

TEST(TileStore, absent_and_incomplete_tiles_read_as_nothing) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const TileKey key{0, 1, 2};
  EXPECT_FALSE(store.read(key));
  EXPECT_FALSE(store.input_digest(key));
  EXPECT_TRUE(store.list(0).empty());
  for (const char* layer : {"dem", "color", "confidence", "mask"}) {
    store.write(key, random_tile(key, kCells), "d");
    EXPECT_EQ(store.list(0), std::vector{key});
    fs::remove(store.path(key, layer));
    EXPECT_FALSE(store.read(key)) << layer;
    EXPECT_FALSE(store.input_digest(key)) << layer;
    EXPECT_TRUE(store.list(0).empty()) << layer;
  }
}

TEST(TileStore, origin_comes_back_to_the_last_bit) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  Tile tile = random_tile({0, 1, 2}, kCells);
  store.write({0, 1, 2}, tile, "unknown");
  EXPECT_EQ(store.origin({0, 1, 2})->searched, std::nullopt);
  tile.searched = SearchedHeights{-1.0 / 3, 1e7 / 7};
  store.write({0, 1, 2}, tile, "known");
  EXPECT_EQ(store.origin({0, 1, 2})->input_digest, "known");
  EXPECT_EQ(store.origin({0, 1, 2})->searched, tile.searched);
  EXPECT_EQ(store.read({0, 1, 2})->searched, tile.searched);
  EXPECT_FALSE(store.origin({0, 9, 9}));
}

TEST(TileStore, checksum_is_of_the_bytes_and_stamp_of_every_touch) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const TileKey key{0, 1, 2};
  store.write(key, random_tile(key, kCells), "d");
  const std::string checksum = store.checksum(key);
  const std::optional<std::string> stamp = store.stamp(key);
  EXPECT_EQ(store.stamp(key), stamp);
  const std::string bytes = file_bytes(store.path(key, "mask"));
  const auto time = fs::last_write_time(store.path(key, "mask"));
  std::string damaged = bytes;
  damaged[damaged.size() / 2] ^= 1;
  put_bytes(store.path(key, "mask"), damaged);
  fs::last_write_time(store.path(key, "mask"), time);  // as if the clock had been set back
  EXPECT_NE(store.stamp(key), stamp);
  EXPECT_NE(store.checksum(key), checksum);
  put_bytes(store.path(key, "mask"), bytes);
  EXPECT_EQ(store.checksum(key), checksum);
  fs::remove(store.path(key, "mask"));
  EXPECT_FALSE(store.stamp(key));
  EXPECT_THROW(store.checksum(key), Error);
}

TEST(TileStore, remains_of_a_removal_are_listed) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  store.write({0, 1, 2}, random_tile({0, 1, 2}, kCells), "d");
  fs::remove(store.path({0, 1, 2}, "dem"));
  EXPECT_TRUE(store.list(0).empty());
  EXPECT_EQ(store.list_remains(0), std::vector{(TileKey{0, 1, 2})});
}

// A crash between two layers of a tile that is written a second time leaves new layers beside old ones.
TEST(TileStore, layers_of_two_writings_are_no_tile) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const TileKey key{0, 1, 2};
  store.write(key, random_tile(key, kCells, 1), "old");
  const std::string old_dem = file_bytes(store.path(key, "dem"));
  store.write(key, random_tile(key, kCells, 2), "new");
  put_bytes(store.path(key, "dem"), old_dem);
  EXPECT_FALSE(store.read(key));
  EXPECT_FALSE(store.input_digest(key));
}

TEST(TileStore, torn_tile_is_an_error_that_names_the_file) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const TileKey key{0, 1, 2};
  store.write(key, random_tile(key, kCells), "d");
  const std::string whole = file_bytes(store.path(key, "dem"));
  for (const std::size_t length : {std::size_t{0}, whole.size() / 4, whole.size() / 2, whole.size() - 1}) {
    put_bytes(store.path(key, "dem"), whole.substr(0, length));
    const std::string message = message_of<Error>([&] { store.read(key); });
    EXPECT_NE(message.find("dem/l0/x1/y2.tif"), std::string::npos) << message;
  }
}

TEST(TileStore, tile_of_another_place_or_size_is_an_error_that_names_the_file) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  store.write({0, 1, 2}, random_tile({0, 1, 2}, kCells), "d");
  store.write({0, 1, 3}, random_tile({0, 1, 3}, kCells), "d");
  fs::copy_file(store.path({0, 1, 2}, "color"), store.path({0, 1, 3}, "color"), fs::copy_options::overwrite_existing);
  EXPECT_NE(message_of<Error>([&] { store.read({0, 1, 3}); }).find("color/l0/x1/y3.tif"), std::string::npos);

  const TileStore other(folder / "tiles", {2 * kCells, 0.05, 0.05}, raster::local_metric_crs(), "", "");
  EXPECT_THROW(other.read({0, 1, 2}), Error);
}

TEST(TileStore, list_is_sorted_and_knows_only_tiles) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const std::vector<TileKey> keys = {{0, -12, 5}, {0, -2, -30}, {0, -2, 7}, {0, 0, 0}, {0, 3, -1}};
  for (auto key = keys.rbegin(); key != keys.rend(); ++key) store.write(*key, random_tile(*key, kCells), "d");
  put_bytes(folder / "tiles/dem/l0/x0/.y1.skysweep-part1-1.tif", "torn");
  put_bytes(folder / "tiles/dem/l0/x0/y01.tif", "somebody's");
  put_bytes(folder / "tiles/dem/l0/x0/y1.tif.aux.xml", "somebody's");
  put_bytes(folder / "tiles/dem/l0/notes.txt", "somebody's");
  EXPECT_EQ(store.list(0), keys);
  EXPECT_TRUE(store.list(1).empty());
}

TEST(TileStore, removed_tile_is_gone_with_all_its_layers) {
  const TempFolder folder;
  const TileStore store = store_in(folder);
  const TileKey key{0, 1, 2};
  store.write(key, random_tile(key, kCells), "d");
  store.remove(key);
  for (const char* layer : {"dem", "color", "confidence", "mask"}) EXPECT_FALSE(fs::exists(store.path(key, layer)));
  EXPECT_NO_THROW(store.remove(key));
}

}  // namespace
}  // namespace skysweep::tiles
