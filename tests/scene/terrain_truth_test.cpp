// SPDX-License-Identifier: Apache-2.0
// Photographs and truth of shaped ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/error.h"
#include "formats/pose_set.h"
#include "raster/geotiff.h"
#include "raster/photo.h"
#include "scene/flight_plan.h"
#include "scene/simulate.h"
#include "scene/world/ground.h"
#include "terrain_kinds.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const fs::path folder =
      fs::path(testing::TempDir()) /
      (std::string("terrain_truth_") + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name);
  fs::remove_all(folder);
  return folder;
}

std::string bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

Scene small_scene(const Terrain& terrain) {
  Scene scene;
  scene.area_m = {20, 16};
  scene.terrain = terrain;
  scene.camera = camera::camera_from_sensor(10, 10, 200, 150);
  scene.flight.gsd_m = 0.1;
  scene.flight.along_overlap = 0.6;
  scene.flight.across_overlap = 0.5;
  scene.flight.beyond_area_m = -4;
  scene.photographs.format = PhotoFormat::png;
  return scene;
}

TEST(TerrainTruth, the_dtm_is_the_bare_ground_under_buildings_and_the_level_of_water) {
  Scene scene = small_scene(shaped(PlaneTerrain{15, 90, {10, 8}}));
  scene.terrain.water_level_m = -1.5;
  scene.buildings = {{{14, 8}, {4, 4}, 0, 6}};
  scene.origin = {100, 200, 30};
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  simulate(scene, folder, executor);
  const auto dtm = raster::read_float_raster(folder / "truth/dtm.tif");
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  EXPECT_EQ(dtm.labels.content, "ground height");
  EXPECT_EQ(dtm.labels.units, "metre");
  EXPECT_FALSE(dtm.labels.vertical_reference.empty());
  EXPECT_EQ(dtm.extent(), dsm.extent());
  int water = 0, roof = 0;
  for (int row = 0; row < dtm.values.height(); ++row)
    for (int column = 0; column < dtm.values.width(); ++column) {
      const Vec2d p = dtm.georeference.cell_center(column, row) - Vec2d{100, 200};
      const double ground = std::tan(15 * 3.14159265358979323846 / 180) * (p.x - 10);
      EXPECT_NEAR(dtm.values(column, row) - 30, std::max(-1.5, ground), 4e-6);
      water += ground < -1.5;
      const bool built = std::abs(p.x - 14) < 2 && std::abs(p.y - 8) < 2;
      roof += built;
      EXPECT_NEAR(dsm.values(column, row) - 30, built ? 6 : std::max(-1.5, ground), 4e-6);
    }
  EXPECT_GT(water, 500);
  EXPECT_GT(roof, 300);
}

TEST(TerrainTruth, shaped_ground_gives_the_same_bytes_for_one_and_two_threads) {
  for (const Terrain& terrain :
       {shaped(FractalTerrain{5, 0.5}, 4, 12), shaped(QuarryTerrain{{10, 8}, {19, 15}, 0, 2, 2, 1, 70, 0.3})}) {
    const fs::path a = fresh_folder("a"), b = fresh_folder("b");
    Scene scene = small_scene(terrain);
    scene.camera = camera::camera_from_sensor(10, 10, 100, 75);
    scene.flight.gsd_m = 0.2;
    SerialExecutor serial;
    ThreadExecutor two(2);
    simulate(scene, a, serial);
    simulate(scene, b, two);
    for (const char* file : {"images/0001.png", "images/0004.png", "truth/dsm.tif", "truth/dtm.tif", "truth/ortho.tif",
                             "truth/views.tif", "scene.json"})
      EXPECT_EQ(bytes(a / file), bytes(b / file)) << file;
  }
}

double bilinear(const Array2d<Rgb8>& photo, Vec2d pixel) {
  const double x = std::clamp(pixel.x - 0.5, 0., photo.width() - 1.001),
               y = std::clamp(pixel.y - 0.5, 0., photo.height() - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * photo(i, j).g + s * photo(i + 1, j).g) +
         t * ((1 - s) * photo(i, j + 1).g + s * photo(i + 1, j + 1).g);
}

TEST(TerrainTruth, truth_of_hills_projected_into_photographs_has_the_colours_of_the_true_orthophoto) {
  Scene scene = small_scene(shaped(FractalTerrain{5, 0.45}, 6, 15));
  scene.flight.tilt_sigma_deg = 2;
  scene.texture.contrast = 0.5;
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  simulate(scene, folder, executor);
  const Ground ground(scene);
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  const auto ortho = raster::read_color_raster(folder / "truth/ortho.tif");
  const auto views = raster::read_class_raster(folder / "truth/views.tif");
  const auto poses = formats::read_poses((folder / "poses.csv").string());
  double squares = 0;
  int count = 0;
  const double cell = dsm.georeference.cell_m;
  for (std::size_t v = 0; v < poses.images.size(); ++v) {
    const Array2d<Rgb8> photo = raster::read_photo(folder / "images" / poses.images[v].name);
    const camera::Camera camera(poses.images[v].model, poses.images[v].pose);
    for (int row = 0; row < dsm.values.height(); ++row)
      for (int column = 0; column < dsm.values.width(); ++column) {
        if (views.values(column, row) != static_cast<int>(poses.images.size())) continue;  // seen by all: nothing hides
        const Vec2d center = dsm.georeference.cell_center(column, row);
        double sum = 0;
        for (int k = 0; k < 16; ++k) {
          const Vec2d p = center + cell * Vec2d{(k % 4 + 0.5) / 4 - 0.5, (k / 4 + 0.5) / 4 - 0.5};
          sum += bilinear(photo, *camera.project({p.x, p.y, ground.at(p).z}));
        }
        squares += std::pow(sum / 16 - ortho.values(column, row).g, 2);
        ++count;
      }
  }
  EXPECT_GT(count, 2000);
  EXPECT_GT(10 * std::log10(255 * 255 / (squares / count)), 36);
}

TEST(TerrainTruth, ground_that_rises_above_the_flight_is_refused_and_a_long_slope_is_seen_to_its_end) {
  const Scene steep = small_scene(shaped(PlaneTerrain{75, 90, {-10, 8}}));
  SerialExecutor executor;
  EXPECT_THROW(simulate(steep, fresh_folder("steep"), executor), Error);
  const Scene level = small_scene(Terrain{}), tilted = small_scene(shaped(PlaneTerrain{25, 90, {10, 8}}));
  const Box2d near = visible_ground(level, plan_flight(level)), far = visible_ground(tilted, plan_flight(tilted));
  EXPECT_LT(far.min.x, near.min.x - 1);  // downhill the photographs reach further
}

}  // namespace
}  // namespace skysweep::scene
