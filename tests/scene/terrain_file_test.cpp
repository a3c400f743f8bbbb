// SPDX-License-Identifier: Apache-2.0
// Terrain and texture as scene files name them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/geotiff.h"
#include "scene/scene_file.h"
#include "scene/world/ground.h"
#include "terrain_kinds.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

const std::string kCamera = "[camera]\nwidth_px = 640\nheight_px = 480\nfocal_px = 600\n";

Scene parsed(const std::string& terrain) { return parse_scene("area_m = [60, 40]\n" + terrain + kCamera, "s.toml"); }

std::string refusal(const std::string& text) {
  try {
    Ground ground(parsed(text));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::string& sentence) {
  EXPECT_NE(refusal(text).find(sentence), std::string::npos) << refusal(text);
}

fs::path fresh_folder() {
  const fs::path folder = fs::path(testing::TempDir()) /
                          (std::string("terrain_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(TerrainFile, every_kind_has_its_keys_and_each_key_changes_the_ground) {
  struct Case {
    std::string kind, key, other;  // the first may bring further lines along
  };
  const std::vector<Case> cases = {
      {"kind = \"plane\"", "slope_deg = 10", "slope_deg = 11"},
      {"kind = \"plane\"", "azimuth_deg = 10", "azimuth_deg = 20"},
      {"kind = \"plane\"", "center = [1, 2]", "center = [2, 2]"},
      {"kind = \"ramp\"", "slope_deg = 10", "slope_deg = 11"},
      {"kind = \"ramp\"", "length_m = 30", "length_m = 31"},
      {"kind = \"ramp\"", "break_width_m = 0", "break_width_m = 15"},
      {"kind = \"ramp\"", "azimuth_deg = 10", "azimuth_deg = 20"},
      {"kind = \"ramp\"", "center = [30, 20]", "center = [32, 20]"},
      {"kind = \"step\"", "height_m = 2", "height_m = 3"},
      {"kind = \"step\"", "face_deg = 20", "face_deg = 15"},
      {"kind = \"step\"", "azimuth_deg = 10", "azimuth_deg = 200"},
      {"kind = \"step\"", "center = [10, 2]", "center = [50, 2]"},
      {"kind = \"terraces\"", "steps = 1", "steps = 2"},
      {"kind = \"terraces\"", "height_m = 2", "height_m = 3"},
      {"kind = \"terraces\"", "bench_m = 2", "bench_m = 3"},
      {"kind = \"terraces\"", "face_deg = 50", "face_deg = 20"},
      {"kind = \"terraces\"", "azimuth_deg = 10", "azimuth_deg = 200"},
      {"kind = \"terraces\"", "center = [10, 2]", "center = [50, 2]"},
      {"kind = \"sinusoid\"\nrelief_m = 3", "azimuth_deg = 10", "azimuth_deg = 50"},
      {"kind = \"sinusoid\"\nrelief_m = 3", "center = [1, 2]", "center = [12, 2]"},
      {"kind = \"sinusoid\"\nrelief_m = 3", "wavelength_m = 20", "wavelength_m = 30"},
      {"kind = \"fractal\"\nrelief_m = 3", "octaves = 2", "octaves = 3"},
      {"kind = \"fractal\"\nrelief_m = 3", "roughness = 0.3", "roughness = 0.6"},
      {"kind = \"fractal\"\nwavelength_m = 20", "relief_m = 3", "relief_m = 4"},
      {"kind = \"quarry\"", "center = [30, 20]", "center = [20, 12]"},
      {"kind = \"quarry\"", "size_m = [50, 36]", "size_m = [30, 30]"},
      {"kind = \"quarry\"", "heading_deg = 0", "heading_deg = 45"},
      {"kind = \"quarry\"", "steps = 3", "steps = 1"},
      {"kind = \"quarry\"", "height_m = 4", "height_m = 3"},
      {"kind = \"quarry\"", "bench_m = 3", "bench_m = 4"},
      {"kind = \"quarry\"", "face_deg = 72", "face_deg = 60"},
      {"kind = \"quarry\"", "break_width_m = 0.1", "break_width_m = 1"},
      {"kind = \"island\"", "center = [30, 20]", "center = [10, 20]"},
      {"kind = \"island\"", "radius_m = 35", "radius_m = 25"},
      {"kind = \"island\"", "height_m = 12", "height_m = 10"},
      {"kind = \"island\"", "sea_depth_m = 5", "sea_depth_m = 4"},
      {"kind = \"island\"", "hills_m = 6", "hills_m = 0"},
      {"kind = \"island\"", "koch_depth = 4", "koch_depth = 2"},
      {"kind = \"plane\"", "relief_m = 0", "relief_m = 1"},
      {"kind = \"plane\"\nrelief_m = 2", "wavelength_m = 20", "wavelength_m = 30"},
  };
  for (const Case& c : cases) {
    const std::string terrain = "[terrain]\n" + c.kind + "\n";
    const Ground a(parsed(terrain + c.key + "\n")), b(parsed(terrain + c.other + "\n"));
    double difference = 0;
    for (double y = -20; y < 60; y += 0.71)
      for (double x = -20; x < 80; x += 0.73)
        difference = std::max(difference, std::abs(a.at({x, y}).z - b.at({x, y}).z));
    EXPECT_GT(difference, 1e-3) << c.kind << ": " << c.key;
  }
}

TEST(TerrainFile, shapes_without_a_centre_have_it_in_the_middle_of_the_area) {
  const Ground ground(parsed("[terrain]\nkind = \"plane\"\n"));
  EXPECT_NEAR(ground.at({30, 20}).z, 0, 1e-12);
}

TEST(TerrainFile, water_stands_where_it_is_named_and_around_islands_at_zero) {
  EXPECT_FALSE(Ground(parsed("[terrain]\nkind = \"plane\"\n")).water_level_m());
  EXPECT_EQ(Ground(parsed("[terrain]\nrelief_m = 2\nwater_level_m = 0.25\n")).water_level_m(), 0.25);
  EXPECT_EQ(Ground(parsed("[terrain]\nkind = \"island\"\n")).water_level_m(), 0.0);
  EXPECT_EQ(Ground(parsed("[terrain]\nkind = \"island\"\nwater_level_m = 1\n")).water_level_m(), 1.0);
}

TEST(TerrainFile, modifications_lie_on_top_of_any_kind) {
  const std::string plane = "[terrain]\nkind = \"plane\"\nslope_deg = 5\n";
  const Ground before(parsed(plane));
  const Ground after(parsed(plane +
                            "[[terrain.modification]]\nkind = \"crater\"\ncenter = [20, 20]\nsize_m = [12, 12]\n"
                            "depth_m = 1.5\n[[terrain.modification]]\nkind = \"matrix\"\ncenter = [40, 20]\n"
                            "size_m = [4, 4]\ncolumns = 2\nrows = 2\nheights_m = [1, 2, 3, 4]\n"));
  EXPECT_NEAR(after.at({20, 20}).z - before.at({20, 20}).z, -1.5, 1e-12);
  EXPECT_NEAR(after.at({38, 22}).z - before.at({38, 22}).z, 1, 1e-12);
  EXPECT_NEAR(after.at({42, 18}).z - before.at({42, 18}).z, 4, 1e-12);
}

TEST(TerrainFile, wrong_values_are_refused_with_the_key_and_what_it_may_be) {
  expect_refused("[terrain]\nkind = \"hole\"\n", "quarry, island, dem, not \"hole\"");
  expect_refused("[terrain]\nkind = \"plane\"\nslope_deg = 80\n", "slope_deg must lie between 0 and 75");
  expect_refused("[terrain]\nkind = \"ramp\"\nbreak_width_m = 30\n", "break_width_m must not be more than length_m");
  expect_refused("[terrain]\nkind = \"step\"\nface_deg = 90\n", "face_deg must lie between 1 and 85");
  expect_refused("[terrain]\nkind = \"terraces\"\nsteps = 0\n", "steps must lie between");
  expect_refused("[terrain]\nkind = \"fractal\"\n", "relief_m must be above 0");
  expect_refused("[terrain]\nkind = \"fractal\"\nrelief_m = 1\noctaves = 17\n", "octaves must lie between 1 and 16");
  expect_refused("[terrain]\nkind = \"quarry\"\nsize_m = [10, 10]\n", "both sides must be at least");
  expect_refused("[terrain]\nkind = \"quarry\"\nbreak_width_m = 2\n", "break_width_m must not be more than a bench");
  expect_refused("[terrain]\nkind = \"island\"\nkoch_depth = 9\n", "koch_depth must lie between 0 and 6");
  expect_refused("[terrain]\nkind = \"dem\"\n", "file must name the raster");
  expect_refused("[[terrain.modification]]\nkind = \"dent\"\n", "must be crater or matrix");
  expect_refused("[[terrain.modification]]\nkind = \"matrix\"\ncolumns = 2\nrows = 2\nheights_m = [1]\n",
                 "columns x rows numbers");
  expect_refused("[texture]\nkind = \"snow\"\n", "natural, tiles, asphalt, checker, image or none, not \"snow\"");
  expect_refused("[texture]\nkind = \"image\"\n", "file must name the orthophoto");
  expect_refused("[texture]\nkind = \"none\"\ncontrast = 1\n", "none has neither contrast nor finest_m");
}

TEST(TerrainFile, keys_of_another_kind_are_refused_for_they_would_have_no_effect) {
  expect_refused("[terrain]\nkind = \"plane\"\noctaves = 3\n", "octaves");
  expect_refused("[terrain]\nslope_deg = 3\n", "slope_deg");
  expect_refused("[[terrain.modification]]\nkind = \"crater\"\nrows = 3\n", "rows");
  expect_refused("[texture]\nkind = \"asphalt\"\nperiod_m = 3\n", "period_m");
}

// x + 10 y over cells of 2 m, from (1000, 2000) on, as each format has it.
double height(double x, double y) { return (x - 1000) + 0.1 * (y - 2000); }

void expect_ground_of(const fs::path& dem, const fs::path& folder) {
  std::ofstream(folder / "scene.toml")
      << "origin = [1010, 2010, 4]\narea_m = [60, 40]\n[terrain]\nkind = \"dem\"\nfile = \"" << dem.filename().string()
      << "\"\n"
      << kCamera;
  const Ground ground(read_scene(folder / "scene.toml"));
  EXPECT_NEAR(ground.at({25, 17}).z, height(1035, 2027) - 4, 1e-5) << dem;
  EXPECT_NEAR(ground.at({25, 17}).slope.x, 1, 1e-5) << dem;
  EXPECT_NEAR(ground.at({25, 17}).slope.y, 0.1, 1e-5) << dem;
}

TEST(TerrainFile, a_dem_is_read_from_geotiff_ascii_grid_and_xyz_and_lies_in_the_world) {
  const fs::path folder = fresh_folder();
  constexpr int kColumns = 50, kRows = 40;
  constexpr double kCell = 2;
  Array2d<float> heights(kColumns, kRows);
  std::ofstream asc(folder / "dem.asc"), xyz(folder / "dem.xyz");
  asc << "ncols 50\nnrows 40\nxllcorner 1000\nyllcorner 2000\ncellsize 2\nNODATA_value -9999\n";
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = 1000 + (column + 0.5) * kCell, y = 2000 + (kRows - row - 0.5) * kCell;
      heights(column, row) = static_cast<float>(height(x, y));
      asc << height(x, y) << (column + 1 < kColumns ? " " : "\n");
      xyz << x << " " << y << " " << height(x, y) << "\n";
    }
  }
  asc.close();
  xyz.close();
  raster::write_geotiff(folder / "dem.tif",
                        raster::Raster<float>{heights, {raster::local_metric_crs(), {1000, 2080}, kCell}, {}});
  for (const char* file : {"dem.tif", "dem.asc", "dem.xyz"}) expect_ground_of(folder / file, folder);
}

TEST(TerrainFile, a_dem_that_is_missing_has_holes_is_elsewhere_or_in_another_crs_is_refused_by_name) {
  const fs::path folder = fresh_folder();
  const std::string dem = "[terrain]\nkind = \"dem\"\nfile = \"" + (folder / "dem.tif").string() + "\"\n";
  expect_refused(dem, "does not exist");
  Array2d<float> heights(100, 100, 5.f);
  const auto write = [&](const std::string& crs, Vec2d corner) {
    raster::write_geotiff(folder / "dem.tif", raster::Raster<float>{heights, {crs, corner, 1}, {}});
  };
  write(raster::local_metric_crs(), {0, 100});
  EXPECT_EQ(refusal(dem), "accepted");
  write(raster::local_metric_crs(), {1000, 100});
  expect_refused(dem, "set origin and area_m");
  write(raster::crs_from_user_input("EPSG:32632"), {0, 100});
  expect_refused("crs = \"EPSG:32633\"\n" + dem, "gdalwarp -t_srs");
  EXPECT_EQ(refusal("crs = \"EPSG:32632\"\n" + dem), "accepted");
  heights(50, 50) = std::nanf("");
  write(raster::local_metric_crs(), {0, 100});
  expect_refused(dem, "no height in 1 cells");
}

TEST(TerrainFile, scene_json_names_every_kind_and_the_content_of_files) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) {
    Scene scene;
    scene.terrain = terrain;
    const std::string json = scene_to_json(scene);
    const bool named = json.find("\"kind\": \"" + kind_name(terrain) + "\"") != std::string::npos;
    EXPECT_EQ(named, terrain.shape.index() != 0) << name;  // rolling ground is what it is without a name
    EXPECT_EQ(json.find("heights_m") != std::string::npos, !terrain.modifications.empty()) << name;
    EXPECT_EQ(json.find("water_level_m") != std::string::npos, terrain.water_level_m.has_value()) << name;
  }
  Scene plain;
  EXPECT_EQ(scene_to_json(plain).find("kind"), std::string::npos);  // and nothing new about plain ground
}

}  // namespace
}  // namespace skysweep::scene
