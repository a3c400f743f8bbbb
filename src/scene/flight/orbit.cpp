// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "scene/flight/patterns.h"

namespace skysweep::scene {

std::vector<camera::Pose> fly_orbit(const Flight& flight, double altitude_m, Deviations& deviations) {
  const double depression_deg = std::atan2(altitude_m - flight.target.z, flight.radius_m) * 180 / std::numbers::pi;
  std::vector<camera::Pose> poses;
  for (int i = 0; i < flight.photographs; ++i) {
    const double bearing_deg = 360. * i / flight.photographs, bearing = bearing_deg * std::numbers::pi / 180;
    const Vec3d position{flight.target.x + flight.radius_m * std::sin(bearing),
                         flight.target.y + flight.radius_m * std::cos(bearing), altitude_m};
    deviations.advance();
    poses.push_back(deviations.flown({position, bearing_deg + 180, -depression_deg, 0}));
  }
  return poses;
}

}  // namespace skysweep::scene
