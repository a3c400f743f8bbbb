// SPDX-License-Identifier: Apache-2.0
// How many samples a pixel gets, and what they buy.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/executor.h"
#include "scene/flight_plan.h"
#include "scene/render/photograph.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

Scene house_on_level_ground() {
  Scene scene;
  scene.area_m = {24, 20};
  scene.camera = camera::camera_from_sensor(10, 10, 120, 90);
  scene.flight.gsd_m = 0.2;
  scene.buildings.resize(1);
  scene.buildings[0] = {{12, 10}, {8, 6}, 20, 6, RoofKind::gable, 4};
  scene.texture.ground = GroundTexture::none;
  return scene;
}

Array2d<Rgb8> picture(const Scene& scene, float max_error_levels) {
  const std::vector<camera::Pose> poses = plan_flight(scene);
  const World world(scene, visible_ground(scene, poses));
  SerialExecutor executor;
  return take_photograph(world, scene.camera, PixelRays(scene.camera), poses[poses.size() / 2], {}, executor, nullptr,
                         {max_error_levels});
}

double rms(const Array2d<Rgb8>& a, const Array2d<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a.data()[i].g - b.data()[i].g, 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Antialiasing, a_tighter_limit_brings_a_textured_picture_closer_to_the_truth) {
  Scene scene = house_on_level_ground();
  scene.texture.ground = GroundTexture::natural;
  const Array2d<Rgb8> truth = picture(scene, 1e-3f);
  const double four = rms(picture(scene, 0), truth), coarse = rms(picture(scene, 6), truth),
               fine = rms(picture(scene, 2), truth);
  EXPECT_LT(coarse, 0.95 * four);
  EXPECT_LT(fine, 0.75 * coarse);
}

TEST(Antialiasing, further_samples_go_to_edges_only) {
  const Scene scene = house_on_level_ground();
  const Array2d<Rgb8> four = picture(scene, 0), refined = picture(scene, 2);
  int changed = 0;
  for (int row = 1; row + 1 < four.height(); ++row)
    for (int column = 1; column + 1 < four.width(); ++column) {
      if (four(column, row) == refined(column, row)) continue;
      ++changed;
      bool edge = false;  // or the shadow's
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          edge = edge || std::abs(refined(column + i, row + j).g - refined(column, row).g) > 2;
      EXPECT_TRUE(edge) << column << ", " << row;
    }
  EXPECT_GT(changed, 50);
}

TEST(Antialiasing, a_slanting_edge_has_more_than_the_five_greys_of_four_samples) {
  const Scene scene = house_on_level_ground();
  const auto greys = [&](float limit) {
    std::array<bool, 256> seen{};
    for (const Rgb8 pixel : picture(scene, limit)) seen[pixel.g] = true;
    return std::count(seen.begin(), seen.end(), true);
  };
  EXPECT_GT(greys(2), 2 * greys(0));
}

}  // namespace
}  // namespace skysweep::scene
