// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "sweep/cost_volume.h"
#include "sweep/sweep_options.h"

namespace skysweep::sweep {

// Prices of height steps in the units of the cost volume.
struct Penalties {
  int small = 0;  // P1
  int large = 0;  // P2
};

inline Penalties penalties_of(const SweepOptions& options) {
  return {static_cast<int>(std::lround(options.small_step_penalty * kCostScale)),
          static_cast<int>(std::lround(options.large_step_penalty * kCostScale))};
}

}  // namespace skysweep::sweep
