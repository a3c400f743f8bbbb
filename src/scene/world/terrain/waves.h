// SPDX-License-Identifier: Apache-2.0
// Sums of sinusoids: rolling ground, and ground in waves.
#pragma once

#include <vector>

#include "scene/terrain.h"
#include "scene/world/terrain/surface.h"

namespace skysweep::scene {

class Waves final : public TerrainSurface {
 public:
  struct Wave {
    Vec2d wave_number;  // radians per metre
    double amplitude_m = 0, phase = 0;
  };
  explicit Waves(std::vector<Wave> waves) : waves_(std::move(waves)) {}

  HeightSample at(Vec2d p) const override;
  HeightRange heights(const Box2d& box) const override;
  MeshPlan mesh_plan() const override;
  double curvature(const Box2d& box) const override;

  double shortest_wave_m() const;
  const std::vector<Wave>& waves() const { return waves_; }

 private:
  std::vector<Wave> waves_;
};

// The seeded rolling ground of `terrain`; without relief, waves of height 0.
Waves rolling_waves(const Terrain& terrain, std::uint64_t seed);

Waves straight_waves(const SinusoidTerrain& shape, double relief_m, double wavelength_m);

}  // namespace skysweep::scene
