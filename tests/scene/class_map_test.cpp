// SPDX-License-Identifier: Apache-2.0
#include "scene/render/class_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/executor.h"
#include "raster/geotiff.h"
#include "scene/simulate.h"

namespace skysweep::scene {
namespace {

constexpr auto code(SurfaceClass c) { return static_cast<std::uint8_t>(c); }
constexpr std::uint8_t kGround = code(SurfaceClass::ground), kRoof = code(SurfaceClass::roof),
                       kEdge = code(SurfaceClass::facade_edge), kTree = code(SurfaceClass::tree),
                       kThin = code(SurfaceClass::thin), kWater = code(SurfaceClass::water);

// One row of cells of half a metre.
std::vector<int> marked(std::vector<float> heights, std::vector<std::uint8_t> classes, double reach_m) {
  Array2d<float> height(static_cast<int>(heights.size()), 1);
  Array2d<std::uint8_t> map(height.width(), 1);
  for (int i = 0; i < height.width(); ++i) {
    height(i, 0) = heights[static_cast<std::size_t>(i)];
    map(i, 0) = classes[static_cast<std::size_t>(i)];
  }
  mark_facade_edges(height, 0.5, reach_m, map);
  std::vector<int> out;
  for (int i = 0; i < map.width(); ++i)
    if (map(i, 0) == kEdge) out.push_back(i);
  return out;
}

TEST(ClassMap, cells_within_reach_of_a_step_of_a_building_become_its_edge) {
  const std::vector<std::uint8_t> classes = {kGround, kGround, kGround, kGround, kRoof, kRoof, kRoof, kRoof};
  EXPECT_EQ(marked({0, 0, 0, 0, 5, 5, 5, 5}, classes, 0.3), (std::vector<int>{3, 4}));
  EXPECT_EQ(marked({0, 0, 0, 0, 5, 5, 5, 5}, classes, 0.8), (std::vector<int>{2, 3, 4, 5}));
  EXPECT_EQ(marked({0, 0, 0, 0, 1.4f, 1.4f, 1.4f, 1.4f}, classes, 0.3), (std::vector<int>{}));  // below 0.5 + 2 x 0.5
}

TEST(ClassMap, a_slope_a_tree_and_a_wire_make_no_edge) {
  EXPECT_TRUE(marked({0, 0.8f, 1.6f, 2.4f}, {kRoof, kRoof, kRoof, kRoof}, 1).empty());
  EXPECT_TRUE(marked({0, 0, 9, 9}, {kGround, kGround, kTree, kTree}, 1).empty());
  EXPECT_TRUE(marked({5, 5, 9, 5}, {kRoof, kRoof, kThin, kRoof}, 1).empty());
  EXPECT_TRUE(marked({0, 0, 9, 9}, {kGround, kGround, kGround, kGround}, 1).empty());  // a cliff is no building
}

TEST(ClassMap, only_ground_and_roof_are_turned_into_edge) {
  EXPECT_EQ(marked({0, 0, 5, 5, 8}, {kWater, kWater, kRoof, kRoof, kTree}, 5), (std::vector<int>{2, 3}));
}

// Also the scene on which Embree's traversal for coherent packets of rays never came back (world/tracer.cpp).
TEST(ClassMap, of_a_simulated_scene_is_that_told_by_hand) {
  Scene scene;
  scene.area_m = {30, 20};
  scene.camera = camera::camera_from_sensor(10, 10, 100, 75);
  scene.flight.gsd_m = 0.3;
  scene.flight.along_overlap = scene.flight.across_overlap = 0.3;
  scene.photographs.format = PhotoFormat::png;
  scene.truth.cell_m = 0.25;
  scene.buildings.resize(1);
  scene.buildings[0] = {{10, 10}, {8, 6}, 0, 7, RoofKind::gable, 4};
  scene.things.trees = {{{22, 6}, 8, 5, CrownShape::ellipsoid}};
  scene.things.walls = {{{18, 15.1}, {28, 15.1}, 2, 0.5}};
  scene.things.masts = {{{25.1, 12.1}, 12, 0.5}};
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "class_map_by_hand";
  std::filesystem::remove_all(folder);
  SerialExecutor executor;
  simulate(scene, folder, executor);
  const auto classes = raster::read_class_raster(folder / "truth/classes.tif");
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  EXPECT_EQ(raster::read_labels(folder / "truth/classes.tif").content, kClassesContent);
  const double reach = 8 * 0.3;
  int trees = 0, edges = 0;
  for (int row = 0; row < classes.values.height(); ++row)
    for (int column = 0; column < classes.values.width(); ++column) {
      const Vec2d p = classes.georeference.cell_center(column, row);
      const std::uint8_t found = classes.values(column, row);
      const double u = std::abs(p.x - 10), v = std::abs(p.y - 10);  // from the middle of the building
      const double outside = std::hypot(std::max(0., u - 4), std::max(0., v - 3)), inside = std::min(4 - u, 3 - v);
      const double from_edge = outside > 0 ? outside : inside;
      const bool wall = p.x > 18 && p.x < 28 && std::abs(p.y - 15.1) < 0.25;
      const bool mast = std::abs(p.x - 25.1) < 0.25 && std::abs(p.y - 12.1) < 0.25;
      const bool crown = norm(p - Vec2d{22, 6}) < 2.5;
      if (wall || mast) {
        EXPECT_EQ(found, kThin) << p.x << " " << p.y;
        EXPECT_EQ(dsm.values(column, row), mast ? 12.f : 2.f);
      } else if (crown) {
        trees += found == kTree;
        EXPECT_TRUE(found == kTree || found == kGround);  // leaves or a gap
      } else if (std::abs(from_edge - reach) > 0.25) {    // the step lies between cell centres
        EXPECT_EQ(found, from_edge < reach ? kEdge : outside > 0 ? kGround : kRoof) << p.x << " " << p.y;
        edges += found == kEdge;
      }
    }
  EXPECT_GT(trees, 150);
  EXPECT_GT(edges, 500);
}

}  // namespace
}  // namespace skysweep::scene
