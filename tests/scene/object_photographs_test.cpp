// SPDX-License-Identifier: Apache-2.0
// Places on roofs and decks, projected by `camera`, have in the photographs the colours that they have from above.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "camera/camera.h"
#include "core/executor.h"
#include "scene/flight_plan.h"
#include "scene/render/encoding.h"
#include "scene/render/photograph.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

Scene roofs_and_a_bridge() {
  Scene scene;
  scene.area_m = {24, 20};
  scene.camera = camera::camera_from_sensor(10, 10, 240, 180);
  scene.flight.gsd_m = 0.1;
  scene.flight.along_overlap = scene.flight.across_overlap = 0.5;
  scene.flight.beyond_area_m = -4;
  scene.flight.tilt_sigma_deg = 2;
  scene.texture.contrast = 0.6;
  scene.buildings.resize(3);
  scene.buildings[0] = {{6, 5}, {8, 6}, 10, 6, RoofKind::gable, 4};
  scene.buildings[1] = {{17, 5}, {7, 6}, -20, 6.5, RoofKind::hip, 4};
  scene.buildings[2] = {{7, 15}, {8, 7}, 5, 5, RoofKind::shed, 3};
  scene.things.bridges = {{{14, 14}, {22, 16}, 5, 4, 0.6, 0}};
  return scene;
}

double bilinear_green(const Array2d<Rgb8>& photo, Vec2d pixel) {
  const double x = std::clamp(pixel.x - 0.5, 0., photo.width() - 1.001),
               y = std::clamp(pixel.y - 0.5, 0., photo.height() - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * photo(i, j).g + s * photo(i + 1, j).g) +
         t * ((1 - s) * photo(i, j + 1).g + s * photo(i + 1, j + 1).g);
}

TEST(ObjectPhotographs, show_roofs_and_decks_where_the_camera_model_says) {
  const Scene scene = roofs_and_a_bridge();
  const std::vector<camera::Pose> poses = plan_flight(scene);
  const World world(scene, visible_ground(scene, poses));
  SerialExecutor executor;
  const PixelRays rays(scene.camera);
  double squares = 0, squares_off = 0;
  int count = 0;
  constexpr double kPatch = 0.2;  // two GSD
  for (const camera::Pose& pose : poses) {
    const camera::Camera camera(scene.camera, pose);
    const Array2d<Rgb8> photo = take_photograph(world, scene.camera, rays, pose, {}, executor);
    for (double y = 2; y < 18; y += 0.37)
      for (double x = 1; x < 23; x += 0.37) {
        Ray down[16], sight[16];
        SurfacePoint hits[16];
        LinearRgb light[16];
        bool active[16], hidden[16];
        for (int k = 0; k < 16; ++k)
          down[k] = {{x + kPatch * ((k % 4 + 0.5) / 4 - 0.5), y + kPatch * ((k / 4 + 0.5) / 4 - 0.5), 30}, {0, 0, -1}};
        world.look(down, 16, hits, light);
        // Wholly on one plane, wholly seen.
        bool usable = true;
        for (int k = 0; k < 16; ++k) {
          usable = usable && hits[k].facet >= 0 && hits[k].facet == hits[0].facet;
          sight[k] = {hits[k].position + 0.01 * hits[k].normal, pose.center - hits[k].position};
          active[k] = true;
        }
        world.tracer().blocked(sight, active, 16, false, hidden);
        double above = 0, seen = 0, seen_off = 0;
        for (int k = 0; usable && k < 16; ++k) {
          const auto pixel = camera.project(hits[k].position);
          usable = !hidden[k] && pixel && camera.shows(*pixel);
          if (!usable) break;
          above += srgb_level(light[k].g) / 16;
          seen += bilinear_green(photo, *pixel) / 16;
          seen_off += bilinear_green(photo, *pixel + Vec2d{0.5, 0.5}) / 16;
        }
        if (!usable) continue;
        squares += std::pow(seen - above, 2);
        squares_off += std::pow(seen_off - above, 2);
        ++count;
      }
  }
  const auto psnr = [&](double sum) { return 10 * std::log10(255 * 255 / (sum / count)); };
  RecordProperty("psnr_db", std::to_string(psnr(squares)));
  EXPECT_GT(count, 1500);
  EXPECT_GT(psnr(squares), 35);
  EXPECT_LT(psnr(squares_off), psnr(squares) - 4);  // the figure does tell geometry right to a fraction of a pixel
}

}  // namespace
}  // namespace skysweep::scene
