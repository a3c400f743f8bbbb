// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <cmath>

namespace skysweep::scene {

double Scene::finest_detail_m() const { return texture.finest_m > 0 ? texture.finest_m : 0.5 * flight.gsd_m; }

double Scene::truth_cell_m() const {
  if (truth.cell_m > 0) return truth.cell_m;
  const double wanted = 2 * flight.gsd_m;
  // Division by a power of ten that is exact in double gives the double nearest to the decimal number.
  const double digits = 1 - std::floor(std::log10(wanted));
  return digits >= 0 ? std::round(wanted * std::pow(10, digits)) / std::pow(10, digits)
                     : std::round(wanted / std::pow(10, -digits)) * std::pow(10, -digits);
}

}  // namespace skysweep::scene
