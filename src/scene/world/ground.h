// SPDX-License-Identifier: Apache-2.0
// The height of the bare ground, in closed form.
#pragma once

#include <array>

#include "core/vec.h"
#include "scene/scene.h"

namespace skysweep::scene {

class Ground {
 public:
  Ground(const Terrain& terrain, std::uint64_t seed);

  struct Sample {
    double z = 0;
    Vec2d slope;  // dz/dx, dz/dy
  };
  Sample at(Vec2d p) const;

  bool level() const { return level_; }
  double shortest_wave_m() const;

 private:
  struct Wave {
    Vec2d wave_number;  // radians per metre
    double amplitude_m = 0, phase = 0;
  };
  std::array<Wave, 4> waves_;
  bool level_ = true;
};

}  // namespace skysweep::scene
