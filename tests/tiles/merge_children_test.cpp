// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tiles/pyramid.h"
#include "tiles/random_tile.h"

namespace skysweep::tiles {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kCells = 8;

Tile empty_tile() { return merge_children({}, kCells); }

// A tile whose north-west 2 x 2 cells have the given heights, colours and sources, row by row.
Tile tile_with_heights(float a, float b, float c, float d) {
  Tile tile = empty_tile();
  tile.dem_max = {};
  tile.dem(0, 0) = a, tile.dem(1, 0) = b, tile.dem(0, 1) = c, tile.dem(1, 1) = d;
  return tile;
}

Tile merge_north_west(const Tile& child) { return merge_children({nullptr, nullptr, &child, nullptr}, kCells); }

TEST(MergeChildren, height_is_the_mean_of_the_known_cells_and_dem_max_the_highest) {
  const Tile parent = merge_north_west(tile_with_heights(1, kNaN, 3, 8));
  EXPECT_EQ(parent.dem(0, 0), 4.0f);
  EXPECT_EQ(parent.dem_max(0, 0), 8.0f);
  EXPECT_TRUE(std::isnan(parent.dem(1, 0)));
  EXPECT_TRUE(std::isnan(parent.dem_max(1, 0)));
}

TEST(MergeChildren, dem_max_goes_on_from_the_children_s_dem_max) {
  Tile child = tile_with_heights(1, 1, 1, 1);
  child.dem_max = child.dem;
  child.dem_max(1, 1) = 50;
  const Tile parent = merge_north_west(child);
  EXPECT_EQ(parent.dem(0, 0), 1.0f);
  EXPECT_EQ(parent.dem_max(0, 0), 50.0f);
}

TEST(MergeChildren, colour_is_the_mean_of_the_known_ones_only) {
  Tile child = tile_with_heights(kNaN, kNaN, kNaN, kNaN);
  child.color(0, 0) = {10, 20, 30, 255};
  child.color(1, 1) = {11, 40, 255, 255};
  child.color(1, 0) = {99, 99, 99, 0};
  const Tile parent = merge_north_west(child);
  EXPECT_EQ(parent.color(0, 0), (Rgba8{11, 30, 143, 255}));  // 10.5 and 142.5 are rounded up
  EXPECT_EQ(parent.color(1, 0), (Rgba8{0, 0, 0, 0}));
}

TEST(MergeChildren, confidence_is_the_root_mean_square) {
  Tile child = tile_with_heights(0, 0, 0, 0);
  child.confidence(0, 0) = 3, child.confidence(1, 0) = 4;
  EXPECT_FLOAT_EQ(merge_north_west(child).confidence(0, 0), std::sqrt(12.5f));
}

TEST(MergeChildren, mask_prefers_measured_to_filled_to_planar) {
  const auto merged = [](CellSource a, CellSource b) {
    Tile child = empty_tile();
    child.mask(0, 0) = static_cast<std::uint8_t>(a);
    child.mask(1, 1) = static_cast<std::uint8_t>(b);
    return static_cast<CellSource>(merge_north_west(child).mask(0, 0));
  };
  EXPECT_EQ(merged(CellSource::filled, CellSource::measured), CellSource::measured);
  EXPECT_EQ(merged(CellSource::planar, CellSource::filled), CellSource::filled);
  EXPECT_EQ(merged(CellSource::none, CellSource::planar), CellSource::planar);
  EXPECT_EQ(merged(CellSource::none, CellSource::none), CellSource::none);
}

TEST(MergeChildren, every_child_lands_in_its_own_quadrant) {
  std::array<Tile, 4> tiles;
  std::array<const Tile*, 4> children{};
  for (int i = 0; i < 4; ++i) {
    tiles[i] = empty_tile();
    tiles[i].dem = Array2d<float>(kCells, kCells, static_cast<float>(i));
    children[i] = &tiles[i];
  }
  const Tile parent = merge_children(children, kCells);
  EXPECT_EQ(parent.dem(0, kCells - 1), 0.0f);           // south-west
  EXPECT_EQ(parent.dem(kCells - 1, kCells - 1), 1.0f);  // south-east
  EXPECT_EQ(parent.dem(0, 0), 2.0f);                    // north-west
  EXPECT_EQ(parent.dem(kCells - 1, 0), 3.0f);           // north-east
  EXPECT_EQ(parent.dem(kCells / 2, kCells / 2), 1.0f);
}

TEST(MergeChildren, dem_max_is_never_below_dem_however_often_merged) {
  std::array<Tile, 4> level;
  for (int i = 0; i < 4; ++i) level[i] = random_tile({0, i, 0}, kCells);
  for (int l = 1; l < 6; ++l) {
    Tile parent = merge_children({&level[0], &level[1], &level[2], &level[3]}, kCells);
    for (std::size_t i = 0; i < parent.dem.size(); ++i) {
      EXPECT_EQ(std::isnan(parent.dem.data()[i]), std::isnan(parent.dem_max.data()[i]));
      EXPECT_FALSE(parent.dem_max.data()[i] < parent.dem.data()[i]);
    }
    level.fill(parent);
  }
}

}  // namespace
}  // namespace skysweep::tiles
