// SPDX-License-Identifier: Apache-2.0
// What a perfect reconstruction of the mapped area would give.
#pragma once

#include <functional>
#include <vector>

#include "camera/camera.h"
#include "core/executor.h"
#include "raster/geotiff.h"
#include "scene/world/world.h"

namespace skysweep::scene {

// Cells of the absolute lattice (corners at whole multiples of the cell in world coordinates) that cover an area.
struct TruthGrid {
  Vec2d north_west_corner;  // world
  double cell_m = 1;
  int width = 0, height = 0;

  // Centre of a cell in the scene's frame, which lies at `origin` in the world.
  Vec2d center(int column, int row, Vec3d origin) const {
    return {north_west_corner.x - origin.x + (column + 0.5) * cell_m,
            north_west_corner.y - origin.y - (row + 0.5) * cell_m};
  }
};
TruthGrid truth_grid(const Scene& scene);

struct TruthLayers {
  Array2d<float> dsm;             // highest surface at the cell's centre, world height, metres
  Array2d<float> dtm;             // bare ground there, or the water on it
  Array2d<Rgba8> ortho;           // colour seen from above, averaged over the cell
  Array2d<std::uint8_t> views;    // photographs that see the surface at the cell's centre (at most 255)
  Array2d<std::uint8_t> classes;  // SurfaceClass, facade edges marked (render/class_map.h)
};

// `cameras` in the scene's frame. `facade_edge_reach_m`: as mark_facade_edges has it.
TruthLayers make_truth(const World& world, const TruthGrid& grid, Vec3d origin,
                       const std::vector<camera::Camera>& cameras, double facade_edge_reach_m, Executor& executor);

}  // namespace skysweep::scene
