// SPDX-License-Identifier: Apache-2.0
#include "scene/world/ground_cover.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "raster/crs.h"
#include "raster/geotiff.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

constexpr Box2d kVisible{{-300, -300}, {600, 600}};

Scene level_scene(double gsd_m) {
  Scene scene;
  scene.camera = camera::camera_from_sensor(10, 10, 200, 150);
  scene.flight.gsd_m = gsd_m;
  scene.light.shadows = false;
  return scene;
}

// Green light that comes straight up from points.
std::vector<float> light_at(const World& world, const std::vector<Vec2d>& points) {
  std::vector<float> out;
  for (std::size_t first = 0; first < points.size(); first += Tracer::kBatch) {
    const int count = static_cast<int>(std::min<std::size_t>(Tracer::kBatch, points.size() - first));
    std::array<Ray, Tracer::kBatch> rays;
    std::array<SurfacePoint, Tracer::kBatch> hits;
    std::array<LinearRgb, Tracer::kBatch> light;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      rays[i] = {{points[first + i].x, points[first + i].y, world.highest_m() + 1}, {0, 0, -1}};
    world.look(rays.data(), count, hits.data(), light.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) out.push_back(light[i].g);
  }
  return out;
}

double mean_light(const World& world, Vec2d corner, double side) {
  constexpr int kPerSide = 6;
  std::vector<Vec2d> points;
  for (int j = 0; j < kPerSide; ++j)
    for (int i = 0; i < kPerSide; ++i)
      points.push_back(corner + side * Vec2d{(i + 0.5) / kPerSide, (j + 0.5) / kPerSide});
  double sum = 0;
  for (const float v : light_at(world, points)) sum += v;
  return sum / (kPerSide * kPerSide);
}

// Root mean square difference of the means of neighbouring squares of a size, over their mean: a Haar wavelet's view of
// the octave.
double contrast_at(const World& world, double size_m) {
  Random random(7);
  double squares = 0, mean = 0;
  constexpr int kPlaces = 150;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec2d corner{random.uniform(0, 200), random.uniform(0, 200)};
    const double a = mean_light(world, corner, size_m), b = mean_light(world, corner + Vec2d{size_m, 0}, size_m);
    squares += (a - b) * (a - b);
    mean += 0.5 * (a + b);
  }
  return std::sqrt(squares / kPlaces) / (mean / kPlaces);
}

TEST(GroundCover, natural_ground_has_detail_in_every_octave_from_half_a_gsd_on) {
  for (const double gsd : {0.005, 0.05, 0.5}) {
    const World world(level_scene(gsd), kVisible);
    for (double size = 0.5 * gsd; size < std::min(200 * gsd, 8.0); size *= 2)
      EXPECT_GT(contrast_at(world, size), 0.08) << "GSD " << gsd << ", squares of " << size << " m";
  }
}

// Correlation of the ground with itself, moved by `shift`.
double correlation(const World& world, Vec2d shift) {
  std::vector<Vec2d> here, there;
  Random random(9);
  for (int i = 0; i < 6000; ++i) {
    here.push_back({random.uniform(0, 150), random.uniform(0, 150)});
    there.push_back(here.back() + shift);
  }
  const std::vector<float> a = light_at(world, here), b = light_at(world, there);
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i], sb += b[i];
    saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
  }
  return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

TEST(GroundCover, natural_ground_repeats_nowhere_and_tiles_repeat_everywhere) {
  const World natural(level_scene(0.05), kVisible);
  Random random(3);
  for (int i = 0; i < 60; ++i)
    EXPECT_LT(std::abs(correlation(natural, {random.uniform(12, 150), random.uniform(12, 150)})), 0.2);
  Scene scene = level_scene(0.05);
  scene.texture.ground = GroundTexture::tiles;
  scene.texture.period_m = 1.5;
  const World tiles(scene, kVisible);
  EXPECT_GT(correlation(tiles, {1.5, 3}), 0.98);  // points within rounding of a joint may change sides
  EXPECT_LT(correlation(tiles, {0.75, 3}), 0.3);
}

TEST(GroundCover, asphalt_has_no_contrast_and_a_checker_has_two_greys) {
  Scene scene = level_scene(0.05);
  scene.texture.ground = GroundTexture::asphalt;
  const World asphalt(scene, kVisible);
  EXPECT_LT(contrast_at(asphalt, 0.05), 1e-6);
  EXPECT_LT(contrast_at(asphalt, 3), 1e-6);
  scene.texture.ground = GroundTexture::checker;
  scene.texture.period_m = 2;
  const World checker(scene, kVisible);
  const std::vector<float> light = light_at(checker, {{1, 1}, {3, 1}, {1, 3}, {3, 3}, {-1, 1}});
  EXPECT_EQ(light[0], light[3]);
  EXPECT_EQ(light[1], light[2]);
  EXPECT_EQ(light[1], light[4]);
  EXPECT_GT(light[0], 2 * light[1]);
}

TEST(GroundCover, without_texture_ground_and_roofs_have_a_grey_each) {
  Scene scene = level_scene(0.05);
  scene.town.emplace();
  scene.texture.ground = GroundTexture::none;
  scene.light.shadows = false;
  const World world(scene, kVisible);
  std::map<Face, std::set<std::tuple<float, float, float>>> colors;
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    const Ray down{{random.uniform(0, 160), random.uniform(0, 160), 200}, {0, 0, -1}};
    SurfacePoint hit;
    LinearRgb light;
    world.look(&down, 1, &hit, &light);
    colors[hit.face].insert({light.r, light.g, light.b});
  }
  EXPECT_EQ(colors[Face::ground].size(), 1u);
  EXPECT_EQ(colors[Face::top].size(), 1u);
  EXPECT_NE(colors[Face::ground], colors[Face::top]);
}

TEST(GroundCover, an_orthophoto_lies_on_the_ground_where_its_coordinates_say) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "ground_cover_ortho.tif";
  Array2d<Rgba8> colors(40, 30, {128, 128, 128, 255});
  colors(10, 5) = {255, 128, 128, 255};
  raster::write_geotiff(path, raster::Raster<Rgba8>{colors, {raster::local_metric_crs(), {1000, 2030}, 1}, {}});
  Scene scene = level_scene(0.5);
  scene.area_m = {40, 30};
  scene.origin = {1000, 2000, 50};
  scene.texture.ground = GroundTexture::image;
  scene.texture.image = path;
  const Ground ground(scene);
  const GroundCover cover(scene, ground);
  EXPECT_TRUE(cover.replaces());
  EXPECT_NEAR(cover.replacement({10.5, 24.5}).r, 1, 1e-6);  // column 10, row 5, counted from the north
  EXPECT_NEAR(cover.replacement({20.5, 24.5}).r, std::pow((128 / 255. + 0.055) / 1.055, 2.4), 1e-6);
  EXPECT_NEAR(cover.replacement({11, 24.5}).r, 0.5 * (1 + std::pow((128 / 255. + 0.055) / 1.055, 2.4)), 1e-6);
  EXPECT_EQ(cover.replacement({-5, 10}).g, cover.replacement({5, 10}).g);  // mirrored beyond
  scene.area_m = {60, 30};
  EXPECT_THROW(GroundCover(scene, ground), Error);
  scene.texture.image = "missing.tif";
  EXPECT_THROW(GroundCover(scene, ground), Error);
}

TEST(GroundCover, steep_ground_shows_rock_and_shores_show_sand_and_deep_water_is_dark) {
  Scene scene = level_scene(0.1);
  IslandTerrain island;
  island.center = {50, 50};
  scene.terrain.shape = island;
  scene.terrain.water_level_m = 0;
  const Ground ground(scene);
  const GroundCover cover(scene, ground);
  const LinearRgb grass{0.1f, 0.2f, 0.05f};
  const LinearRgb level = cover.bared(grass, {50, 50, 9}, {0, 0, 1});
  EXPECT_GT(level.g, level.r);  // still green
  const LinearRgb steep = cover.bared(grass, {50, 50, 9}, normalized({1, 0, 0.4}));
  EXPECT_GT(steep.r, steep.g);
  const LinearRgb shore = cover.bared(grass, {50, 50, 0.25}, {0, 0, 1});
  EXPECT_GT(shore.r, shore.g);
  const LinearRgb deep = cover.water({-100, -100, 0});
  EXPECT_LT(deep.r + deep.g + deep.b, 0.3f);
  EXPECT_GT(deep.b, deep.r);
}

}  // namespace
}  // namespace skysweep::scene
