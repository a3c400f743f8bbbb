// SPDX-License-Identifier: Apache-2.0
#include "scene/render/surveyed_points.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "scene/render/encoding.h"
#include "scene/render/sightings.h"

namespace skysweep::scene {
namespace {

// The field (column, row) of a division of the area in columns x rows: a place in its inner part, so that neighbouring
// points keep apart.
Vec2d place_in_field(const Scene& scene, int column, int row, int columns, int rows, Random& random) {
  const double x = random.uniform(0.15, 0.85), y = random.uniform(0.15, 0.85);
  return {(column + x) / columns * scene.area_m.x, (row + y) / rows * scene.area_m.y};
}

}  // namespace

std::vector<SurveyedPoint> survey(const Scene& scene, const World& world, const std::vector<camera::Camera>& cameras,
                                  const SurveyOptions& options) {
  std::vector<SurveyedPoint> points;
  if (options.count == 0) return points;
  const double wanted = std::sqrt(options.count * scene.area_m.x / scene.area_m.y);
  const int columns = std::clamp(static_cast<int>(std::lround(wanted)), 1, options.count);
  const int rows = (options.count + columns - 1) / columns;
  Random random(mix64(scene.seed) ^ options.stream);
  for (int field = 0; field < options.count; ++field) {
    const Vec2d place = place_in_field(scene, field % columns, field / columns, columns, rows, random);
    const Ray down{{place.x, place.y, world.highest_m() + 1}, {0, 0, -1}};
    SurfacePoint surface;
    LinearRgb light;
    world.look(&down, 1, &surface, &light);
    if (surface.face == Face::none || (options.on_ground && surface.face != Face::ground)) continue;
    SurveyedPoint point{surface.position,
                        {to_byte(srgb_level(light.r)), to_byte(srgb_level(light.g)), to_byte(srgb_level(light.b))},
                        {}};
    for_each_sighting(world, surface, cameras, [&](std::size_t i, Vec2d pixel) {
      point.sightings.push_back({i, pixel});
    });
    if (static_cast<int>(point.sightings.size()) >= options.min_sightings) points.push_back(std::move(point));
  }
  return points;
}

}  // namespace skysweep::scene
