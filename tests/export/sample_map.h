// SPDX-License-Identifier: Apache-2.0
// A small map with levels, whose heights and colours follow formulas, and programs of others to read exports with.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "tiles/pyramid.h"
#include "tiles/tile_store.h"

namespace skysweep::exports {

struct ProgramResult {
  int status = -1;
  std::string output;
};

inline ProgramResult run(const std::string& command) {
  ProgramResult result;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  result.status = ::pclose(pipe);
  return result;
}

// What gdallocationinfo reads of band 1 (or all bands, one after the other) at places: in the file's own CRS with
// "-geoloc", in cells without. NaN where the file has nothing.
inline std::vector<double> values_at(const std::filesystem::path& file, const std::vector<Vec2d>& places,
                                     const std::string& options = "") {
  std::ostringstream list;
  list.precision(17);
  for (const Vec2d p : places) list << p.x << " " << p.y << "\\n";
  const ProgramResult result =
      run("printf '" + list.str() + "' | gdallocationinfo -valonly " + options + " '" + file.string() + "'");
  EXPECT_EQ(result.status, 0) << result.output;
  std::vector<double> values;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);)
    values.push_back(line.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(line.c_str(), nullptr));
  return values;
}

// 3 x 2 tiles of 64 cells of 0.5 m near Munich, their south-west corner at kCorner, with a hole in the middle tile and
// the north-east tile missing.
class SampleMap : public testing::Test {
 protected:
  static constexpr int kCells = 64;
  static constexpr double kCellM = 0.5;
  static constexpr int kFirstX = 21600, kFirstY = 166688;
  static constexpr Vec2d kCorner = {kFirstX * kCells * kCellM, kFirstY* kCells* kCellM};

  explicit SampleMap(const std::string& crs = "EPSG:32632+5773") : store(make_store(crs)) {
    std::vector<tiles::TileKey> keys;
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 2; ++y) {
        if (x == 2 && y == 1) continue;
        keys.push_back({0, kFirstX + x, kFirstY + y});
        store.write(keys.back(), tile(keys.back()), keys.back().name());
      }
    tiles::update_parents(store);
  }

  // metres east and north of kCorner
  static double height(Vec2d p) { return 510 + 3 * std::sin(p.x / 9) + 2 * std::cos(p.y / 7); }
  static Rgba8 color(Vec2d p) {
    const auto wave = [](double a) { return static_cast<std::uint8_t>(128 + 100 * std::sin(a)); };
    return {wave(p.x / 5), wave(p.y / 6), wave((p.x + p.y) / 8), 255};
  }
  static bool is_hole(Vec2d p) { return p.x > 40 && p.x < 46 && p.y > 10 && p.y < 15; }

  tiles::TileStore make_store(const std::string& crs) const {
    const std::string wkt = crs.empty() ? raster::local_metric_crs() : raster::crs_from_user_input(crs);
    return {folder / "tiles", {kCells, kCellM, 0.05}, wkt, raster::vertical_reference(wkt), "skysweep test"};
  }

  tiles::Tile tile(tiles::TileKey key) const {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    tiles::Tile t{Array2d<float>(kCells, kCells, kNaN),
                  {},
                  Array2d<Rgba8>(kCells, kCells),
                  Array2d<float>(kCells, kCells, kNaN),
                  Array2d<std::uint8_t>(kCells, kCells)};
    for (int row = 0; row < kCells; ++row)
      for (int column = 0; column < kCells; ++column) {
        const Vec2d p{((key.x - kFirstX) * kCells + column + 0.5) * kCellM,
                      ((key.y - kFirstY + 1) * kCells - row - 0.5) * kCellM};
        if (is_hole(p)) continue;
        t.dem(column, row) = static_cast<float>(height(p));
        t.color(column, row) = color(p);
        t.confidence(column, row) = static_cast<float>(0.05 + 0.001 * p.x);
        t.mask(column, row) = p.x < 50 ? 1 : 2;
      }
    return t;
  }

  testing_support::TempFolder folder;
  tiles::TileStore store;
};

}  // namespace skysweep::exports
