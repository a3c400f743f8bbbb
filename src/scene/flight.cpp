// SPDX-License-Identifier: Apache-2.0
#include "scene/flight.h"

#include <algorithm>
#include <cmath>

namespace skysweep::scene {

std::vector<double> Flight::resolved_altitudes_m(double focal_px) const {
  if (pattern == FlightPattern::given) {
    std::vector<double> heights;
    for (const camera::Pose& pose : poses) heights.push_back(pose.center.z);
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return {*middle};
  }
  return altitudes_m.empty() ? std::vector<double>{gsd_m * focal_px} : altitudes_m;
}

double Flight::resolved_gsd_m(double focal_px) const {
  if (pattern == FlightPattern::strips && altitudes_m.empty()) return gsd_m;
  const std::vector<double> altitudes = resolved_altitudes_m(focal_px);
  const double lowest = *std::min_element(altitudes.begin(), altitudes.end());
  if (pattern == FlightPattern::orbit) return std::hypot(radius_m, lowest - target.z) / focal_px;
  return lowest / focal_px;
}

}  // namespace skysweep::scene
