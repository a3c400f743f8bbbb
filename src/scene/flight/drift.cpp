// SPDX-License-Identifier: Apache-2.0
#include "scene/flight/drift.h"

#include <cmath>

namespace skysweep::scene {

Drift::Drift(const Flight& flight, std::uint64_t seed)
    : flight_(flight), kept_(std::exp(-1 / flight.drift_photographs)), random_(seed) {
  for (double& value : state_) value = random_.normal();
}

Drift::Deviation Drift::next() {
  const double fresh = std::sqrt(1 - kept_ * kept_);
  const std::array<double, 6> now = state_;
  for (double& value : state_) value = kept_ * value + fresh * random_.normal();
  const double shift = flight_.drift_sigma_m, tilt = flight_.tilt_drift_sigma_deg;
  return {{shift * now[0], shift * now[1], shift * now[2]}, 2 * tilt * now[3], tilt * now[4], tilt * now[5]};
}

}  // namespace skysweep::scene
