// SPDX-License-Identifier: Apache-2.0
#include "render/look.h"

#include <cmath>
#include <numbers>

namespace skysweep::render {

const std::vector<std::string>& look_names() {
  static const std::vector<std::string> names = {"orthophoto", "hillshade", "relief", "slope",
                                                 "confidence", "views",     "level"};
  return names;
}

Vec3d Sun::direction() const {
  const double azimuth = azimuth_deg * std::numbers::pi / 180, elevation = elevation_deg * std::numbers::pi / 180;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

}  // namespace skysweep::render
