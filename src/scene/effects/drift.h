// SPDX-License-Identifier: Apache-2.0
// Slow random deviations over a flight.
#pragma once

#include <cstdint>
#include <vector>

namespace skysweep::scene {

// A stationary Gauss-Markov sequence: mean 0, variance 1, correlation exp(-k / correlation) of values k apart.
std::vector<double> drift(int count, double correlation, std::uint64_t seed);

}  // namespace skysweep::scene
