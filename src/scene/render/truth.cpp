// SPDX-License-Identifier: Apache-2.0
#include "scene/render/truth.h"

#include <algorithm>
#include <cmath>

#include "scene/render/class_map.h"
#include "scene/render/encoding.h"
#include "scene/render/sightings.h"

namespace skysweep::scene {
namespace {

constexpr int kSamplesPerSide = 4;
static_assert(kSamplesPerSide * kSamplesPerSide <= Tracer::kBatch);

Ray straight_down(const World& world, Vec2d p) { return {{p.x, p.y, world.highest_m() + 1}, {0, 0, -1}}; }

Rgba8 color_of_cell(const World& world, Vec2d center, double cell_m) {
  Ray rays[Tracer::kBatch];
  SurfacePoint hits[Tracer::kBatch];
  LinearRgb light[Tracer::kBatch];
  int count = 0;
  for (int j = 0; j < kSamplesPerSide; ++j)
    for (int i = 0; i < kSamplesPerSide; ++i) {
      const Vec2d offset{(i + 0.5) / kSamplesPerSide - 0.5, (j + 0.5) / kSamplesPerSide - 0.5};
      rays[count++] = straight_down(world, center + cell_m * offset);
    }
  world.look(rays, count, hits, light);
  LinearRgb sum;
  for (int i = 0; i < count; ++i) sum = sum + light[i];
  const LinearRgb mean = 1.f / static_cast<float>(count) * sum;
  return {to_byte(srgb_level(mean.r)), to_byte(srgb_level(mean.g)), to_byte(srgb_level(mean.b)), 255};
}

int count_views(const World& world, const SurfacePoint& point, const std::vector<camera::Camera>& cameras) {
  int views = 0;
  for_each_sighting(world, point, cameras, [&](std::size_t, Vec2d) { ++views; });
  return views;
}

}  // namespace

TruthGrid truth_grid(const Scene& scene) {
  const double cell = scene.truth_cell_m();
  // A border within a millionth of a cell of the lattice lies on it.
  const auto below = [cell](double v) { return std::floor(v / cell + 1e-6); };
  const auto above = [cell](double v) { return std::ceil(v / cell - 1e-6); };
  const double west = below(scene.origin.x), east = above(scene.origin.x + scene.area_m.x);
  const double south = below(scene.origin.y), north = above(scene.origin.y + scene.area_m.y);
  return {{west * cell, north * cell}, cell, static_cast<int>(east - west), static_cast<int>(north - south)};
}

TruthLayers make_truth(const World& world, const TruthGrid& grid, Vec3d origin,
                       const std::vector<camera::Camera>& cameras, double facade_edge_reach_m, Executor& executor) {
  TruthLayers out{Array2d<float>(grid.width, grid.height), Array2d<float>(grid.width, grid.height),
                  Array2d<Rgba8>(grid.width, grid.height), Array2d<std::uint8_t>(grid.width, grid.height),
                  Array2d<std::uint8_t>(grid.width, grid.height)};
  executor.parallel_for(grid.height, [&](int row) {
    for (int column = 0; column < grid.width; ++column) {
      const Vec2d center = grid.center(column, row, origin);
      const Ray down = straight_down(world, center);
      SurfacePoint surface;
      world.tracer().first_hits(&down, 1, &surface);
      out.dsm(column, row) = static_cast<float>(surface.position.z + origin.z);
      out.dtm(column, row) = static_cast<float>(world.ground_m(center) + origin.z);
      out.classes(column, row) = static_cast<std::uint8_t>(world.surface_class(surface));
      out.ortho(column, row) = color_of_cell(world, center, grid.cell_m);
      out.views(column, row) = static_cast<std::uint8_t>(std::min(255, count_views(world, surface, cameras)));
    }
  });
  mark_facade_edges(out.dsm, grid.cell_m, facade_edge_reach_m, out.classes);
  return out;
}

}  // namespace skysweep::scene
