// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/drift.h"

#include <cmath>

#include "core/random.h"

namespace skysweep::scene {

std::vector<double> drift(int count, double correlation, std::uint64_t seed) {
  Random random(seed);
  const double keep = std::exp(-1 / correlation), fresh = std::sqrt(1 - keep * keep);
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(i == 0 ? random.normal() : keep * out.back() + fresh * random.normal());
  return out;
}

}  // namespace skysweep::scene
