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

Sun usual_sun(const View& view) {
  constexpr double kFromAbove = -0.8;  // steeper than 53 degrees
  const double right_deg = std::atan2(view.right().x, view.right().y) * 180 / std::numbers::pi;
  return {right_deg + (view.direction().z < kFromAbove ? 225 : 135), 45};
}

}  // namespace skysweep::render
