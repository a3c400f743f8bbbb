// SPDX-License-Identifier: Apache-2.0
// How an aircraft leaves its plan slowly: a first-order Gauss-Markov process for each coordinate and angle.
#pragma once

#include <array>
#include <cstdint>

#include "core/random.h"
#include "core/vec.h"
#include "scene/flight.h"

namespace skysweep::scene {

class Drift {
 public:
  Drift(const Flight& flight, std::uint64_t seed);

  struct Deviation {
    Vec3d position_m;
    double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  };
  // Of the next position of the flight. Its standard deviations are those of the flight from the first position on.
  Deviation next();

 private:
  const Flight& flight_;
  double kept_;  // correlation of consecutive positions
  Random random_;
  std::array<double, 6> state_{};  // of unit variance
};

}  // namespace skysweep::scene
