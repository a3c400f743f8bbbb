// SPDX-License-Identifier: Apache-2.0
#include "export/mosaic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "tiles/random_tile.h"

namespace skysweep::exports {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using tiles::CellSource;
using tiles::Tile;
using tiles::TileKey;
using tiles::TileStore;

constexpr int kCells = 256;
constexpr double kCellM = 0.1;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TileStore store_in(const fs::path& folder) {
  return {
      folder, {kCells, kCellM, 0.05}, raster::crs_from_user_input("EPSG:32615+5773"), "EGM96 height", "skysweep test"};
}

Tile blank_tile() {
  return {Array2d<float>(kCells, kCells, kNaN),
          {},
          Array2d<Rgba8>(kCells, kCells),
          Array2d<float>(kCells, kCells, kNaN),
          Array2d<std::uint8_t>(kCells, kCells)};
}

// Around the origin, so that indices of both signs meet; one place in the middle has no tile.
const std::vector<TileKey> kKeys = {{0, -2, -1}, {0, -1, -1}, {0, -1, 0}, {0, 0, -1}, {0, 1, 0}, {0, 1, -1}};

TileStore random_map(const fs::path& folder) {
  const TileStore store = store_in(folder);
  for (const TileKey key : kKeys) store.write(key, tiles::random_tile(key, kCells), key.name());
  return store;
}

struct ProgramResult {
  int status = -1;
  std::string output;
};

ProgramResult run(const std::string& command) {
  ProgramResult result;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  result.status = ::pclose(pipe);
  return result;
}

void expect_valid_cog(const fs::path& path) {
  const std::string validator = "/usr/bin/python3 -m osgeo_utils.samples.validate_cloud_optimized_geotiff ";
  if (run("/usr/bin/python3 -c 'import osgeo_utils.samples.validate_cloud_optimized_geotiff'").status != 0)
    GTEST_SKIP() << "the COG validator (python3-gdal) is not installed";
  const ProgramResult result = run(validator + path.string());
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("is a valid cloud optimized GeoTIFF"), std::string::npos) << result.output;
}

TEST(Mosaic, holds_the_tiles_values_across_their_borders) {
  const TempFolder folder;
  const TileStore store = random_map(folder / "tiles");
  const Box2d extent = known_extent(store);
  write_mosaic(store, "dem", extent, folder / "dsm.tif");
  write_mosaic(store, "confidence", extent, folder / "confidence.tif");
  write_mosaic(store, "color", extent, folder / "ortho.tif");
  write_mosaic(store, "mask", extent, folder / "mask.tif");
  const auto dem = raster::read_float_raster(folder / "dsm.tif");
  const auto confidence = raster::read_float_raster(folder / "confidence.tif");
  const auto color = raster::read_color_raster(folder / "ortho.tif");
  const auto mask = raster::read_class_raster(folder / "mask.tif");
  ASSERT_EQ(dem.values.width(), 4 * kCells);
  ASSERT_EQ(dem.values.height(), 2 * kCells);

  const std::set<TileKey> present(kKeys.begin(), kKeys.end());
  long differences = 0;
  for (int tile_y = 0; tile_y < 2; ++tile_y)
    for (int tile_x = 0; tile_x < 4; ++tile_x) {
      const TileKey key{0, tile_x - 2, -tile_y};
      const Tile tile = present.count(key) ? tiles::random_tile(key, kCells) : blank_tile();
      for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
          const int column = tile_x * kCells + x, row = tile_y * kCells + y;
          const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
          differences += !same(dem.values(column, row), tile.dem(x, y)) ||
                         !same(confidence.values(column, row), tile.confidence(x, y)) ||
                         !(color.values(column, row) == tile.color(x, y)) ||
                         mask.values(column, row) != tile.mask(x, y);
        }
    }
  EXPECT_EQ(differences, 0);
  EXPECT_EQ(dem.georeference.north_west_corner, store.lattice().north_west_corner({0, -2, 0}));
  EXPECT_EQ(dem.georeference.cell_m, kCellM);
  EXPECT_EQ(names_in(folder.path()).size(), 5u) << "side files were left behind";
}

TEST(Mosaic, is_a_valid_cog_with_every_label) {
  const TempFolder folder;
  const TileStore store = random_map(folder / "tiles");
  for (const char* layer : {"dem", "color", "confidence", "mask"}) {
    const fs::path path = folder / (std::string(layer) + ".tif");
    write_mosaic(store, layer, known_extent(store), path);
    expect_valid_cog(path);
    const raster::Labels labels = raster::read_labels(path);
    const raster::Labels expected = store.labels(layer, "");
    EXPECT_EQ(labels.content, expected.content);
    EXPECT_EQ(labels.units, expected.units);
    EXPECT_EQ(labels.vertical_reference, expected.vertical_reference);
    EXPECT_EQ(labels.software, "skysweep test");
    EXPECT_EQ(labels.input_digest.size(), 32u);
  }
  const std::string info = run("gdalinfo -json " + (folder / "dem.tif").string()).output;
  for (const char* label : {"\"LAYOUT\":\"COG\"", "\"unit\":\"metre\"", "\"description\":\"surface height\"",
                            "\"VERTICAL_REFERENCE\":\"EGM96 height\"", "UTM zone 15N", "\"overviews\":["})
    EXPECT_NE(info.find(label), std::string::npos) << label << " is missing in\n" << info;
  EXPECT_NE(run("gdalinfo " + (folder / "dem.tif").string()).output.find("NoData Value=nan"), std::string::npos);
  EXPECT_NE(run("gdalinfo " + (folder / "color.tif").string()).output.find("ColorInterp=Alpha"), std::string::npos);
}

TEST(Mosaic, local_frame_is_named_in_it) {
  const TempFolder folder;
  const TileStore store(folder / "tiles", {kCells, kCellM, 0.05}, raster::local_metric_crs(), "unknown",
                        "skysweep test");
  store.write({0, 0, 0}, tiles::random_tile({0, 0, 0}, kCells), "d");
  write_mosaic(store, "dem", known_extent(store), folder / "dsm.tif");
  EXPECT_EQ(raster::read_float_raster(folder / "dsm.tif").georeference.crs_wkt, raster::local_metric_crs());
}

TEST(Mosaic, is_cropped_to_what_is_known_the_same_for_all_layers) {
  const TempFolder folder;
  const TileStore store = store_in(folder / "tiles");
  Tile west = blank_tile();
  west.mask(250, 10) = static_cast<std::uint8_t>(CellSource::measured);
  west.dem(250, 10) = 7;
  Tile east = blank_tile();
  east.mask(3, 200) = static_cast<std::uint8_t>(CellSource::planar);
  east.color(3, 200) = {1, 2, 3, 255};
  store.write({0, -1, 0}, west, "west");
  store.write({0, 0, 0}, east, "east");
  const Box2d extent = known_extent(store);
  EXPECT_NEAR(extent.min.x, -6 * kCellM, 1e-12);
  EXPECT_NEAR(extent.max.x, 4 * kCellM, 1e-12);
  write_mosaic(store, "dem", extent, folder / "dsm.tif");
  write_mosaic(store, "color", extent, folder / "ortho.tif");
  const auto dem = raster::read_float_raster(folder / "dsm.tif");
  const auto color = raster::read_color_raster(folder / "ortho.tif");
  ASSERT_EQ(dem.values.width(), 10);
  ASSERT_EQ(dem.values.height(), 191);
  EXPECT_EQ(dem.values(0, 0), 7.0f);
  EXPECT_EQ(color.values(9, 190), (Rgba8{1, 2, 3, 255}));
  EXPECT_EQ(color.values(0, 0).a, 0);
}

TEST(Mosaic, area_of_interest_takes_the_cells_whose_centres_lie_in_it) {
  const TempFolder folder;
  const TileStore store = random_map(folder / "tiles");
  write_mosaic(store, "dem", {{-0.26, -0.14}, {0.24, 0.16}}, folder / "dsm.tif");
  const auto part = raster::read_float_raster(folder / "dsm.tif");
  ASSERT_EQ(part.values.width(), 5);   // centres -0.25 .. 0.15
  ASSERT_EQ(part.values.height(), 3);  // centres -0.05 .. 0.15
  write_mosaic(store, "dem", known_extent(store), folder / "all.tif");
  const auto all = raster::read_float_raster(folder / "all.tif");
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      const float expected = all.values(2 * kCells - 3 + x, kCells - 2 + y);
      EXPECT_TRUE(part.values(x, y) == expected || (std::isnan(part.values(x, y)) && std::isnan(expected)));
    }
}

TEST(Mosaic, same_tiles_give_the_same_bytes_wherever_the_project_lies) {
  const TempFolder folder;
  const TileStore a = random_map(folder / "a"), b = random_map(folder / "elsewhere/b");
  for (const char* layer : {"dem", "color", "mask"}) {
    write_mosaic(a, layer, known_extent(a), folder / "a.tif");
    write_mosaic(b, layer, known_extent(b), folder / "b.tif");
    EXPECT_EQ(file_bytes(folder / "a.tif"), file_bytes(folder / "b.tif")) << layer;
  }
}

// Overviews: no-data must not leak into them. A plane at 100 m with holes stays a plane at 100 m.
TEST(Mosaic, overviews_leave_no_data_out) {
  const TempFolder folder;
  const TileStore store = store_in(folder / "tiles");
  for (const TileKey key : kKeys) {
    Tile tile = tiles::random_tile(key, kCells);
    for (float& height : tile.dem)
      if (!std::isnan(height)) height = 100;
    for (Rgba8& color : tile.color)
      if (color.a) color = {200, 100, 50, 255};
    store.write(key, tile, key.name());
  }
  write_mosaic(store, "dem", known_extent(store), folder / "dsm.tif");
  write_mosaic(store, "color", known_extent(store), folder / "ortho.tif");
  const auto overview_of = [&](const std::string& name) {
    const fs::path out = folder / ("overview-" + name);
    const ProgramResult result =
        run("gdal_translate -q -oo OVERVIEW_LEVEL=0 " + (folder / name).string() + " " + out.string());
    EXPECT_EQ(result.status, 0) << result.output;
    return out;
  };
  const auto dem = raster::read_float_raster(overview_of("dsm.tif"));
  EXPECT_EQ(dem.values.width(), 2 * kCells);
  for (const float height : dem.values) EXPECT_TRUE(std::isnan(height) || height == 100.0f) << height;
  const auto color = raster::read_color_raster(overview_of("ortho.tif"));
  for (const Rgba8 c : color.values)
    if (c.a > 0) {
      EXPECT_EQ((Rgb8{c.r, c.g, c.b}), (Rgb8{200, 100, 50}));
    }
}

TEST(Mosaic, replaces_the_old_file_only_when_the_new_one_is_whole) {
  const TempFolder folder;
  const TileStore store = random_map(folder / "tiles");
  put_bytes(folder / "dsm.tif", "yesterday's");
  const fs::path victim = store.path({0, 0, -1}, "dem");
  const std::string whole = file_bytes(victim);
  put_bytes(victim, whole.substr(0, whole.size() / 2));
  const std::string message =
      message_of<Error>([&] { write_mosaic(store, "dem", known_extent(store), folder / "dsm.tif"); });
  EXPECT_NE(message.find("dem/l0/x0/y-1.tif"), std::string::npos) << message;
  EXPECT_EQ(file_bytes(folder / "dsm.tif"), "yesterday's");
  EXPECT_EQ(names_in(folder.path()).size(), 2u) << "temporary files were left behind";
  put_bytes(victim, whole);
  write_mosaic(store, "dem", known_extent(store), folder / "dsm.tif");
  EXPECT_GT(fs::file_size(folder / "dsm.tif"), 1000u);
}

TEST(Mosaic, nothing_to_show_is_said) {
  const TempFolder folder;
  const TileStore empty = store_in(folder / "none");
  EXPECT_TRUE(known_extent(empty).empty());
  EXPECT_THROW(write_mosaic(empty, "dem", known_extent(empty), folder / "dsm.tif"), Error);
  const TileStore store = random_map(folder / "tiles");
  EXPECT_THROW(write_mosaic(store, "dem", {{1000, 1000}, {1010, 1010}}, folder / "dsm.tif"), Error);
  EXPECT_FALSE(fs::exists(folder / "dsm.tif"));
}

TEST(Mosaic, unwritable_place_is_an_error_that_names_the_file) {
  const TempFolder folder;
  const TileStore store = random_map(folder / "tiles");
  put_bytes(folder / "file", "");
  const std::string message =
      message_of<Error>([&] { write_mosaic(store, "dem", known_extent(store), folder / "file/dsm.tif"); });
  EXPECT_NE(message.find("file/dsm.tif"), std::string::npos) << message;
}

}  // namespace
}  // namespace skysweep::exports
