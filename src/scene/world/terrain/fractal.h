// SPDX-License-Identifier: Apache-2.0
// Fractal relief: octaves of gradient noise (Perlin 2002, "Improving Noise": quintic blending), in double and with the
// exact slope. Each octave is turned against the one before, so that their lattices do not show.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/terrain.h"
#include "scene/world/terrain/surface.h"

namespace skysweep::scene {

class Fractal final : public TerrainSurface {
 public:
  Fractal(const FractalTerrain& shape, double relief_m, double wavelength_m, std::uint64_t seed);

  HeightSample at(Vec2d p) const override;
  HeightRange heights(const Box2d& box) const override;
  MeshPlan mesh_plan() const override;
  double curvature(const Box2d&) const override { return curvature_; }

 private:
  struct Octave {
    Vec2d axis;  // of its lattice, over its size: 1/m
    Vec2d shift;
    double amplitude_m = 0;
    std::uint32_t seed = 0;
  };
  std::vector<Octave> octaves_;
  double sum_m_ = 0, curvature_ = 0, shortest_m_ = 0;
};

}  // namespace skysweep::scene
