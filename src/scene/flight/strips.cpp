// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "scene/flight/patterns.h"
#include "scene/world/ground.h"

namespace skysweep::scene {
namespace {

// Positions from -reach to reach, not further apart than `spacing`; one in the middle if there is no reach.
std::vector<double> spread(double reach, double spacing) {
  if (!(reach > 0)) return {0};
  const int intervals = std::max(1, static_cast<int>(std::ceil(2 * reach / spacing - 1e-9)));
  std::vector<double> out;
  for (int i = 0; i <= intervals; ++i) out.push_back(-reach + 2 * reach * i / intervals);
  return out;
}

}  // namespace

std::vector<camera::Pose> fly_strips(const Scene& scene, const Flight& flight, double altitude_m,
                                     Deviations& deviations) {
  std::optional<Ground> ground;
  if (flight.terrain_following) ground.emplace(scene);
  // The plan keeps to the GSD that was asked for; altitudes that were asked for have their own.
  const double gsd_m = flight.altitudes_m.empty() ? flight.gsd_m : altitude_m / scene.camera.focal_px();
  const double along_spacing = (1 - flight.along_overlap) * scene.camera.height_px * gsd_m;
  const double across_spacing = (1 - flight.across_overlap) * scene.camera.width_px * gsd_m;
  const Vec2d center = 0.5 * scene.area_m;

  std::vector<camera::Pose> poses;
  for (int set = 0; set < (flight.cross_strips ? 2 : 1); ++set) {
    const double heading_deg = flight.heading_deg + 90 * set, heading = heading_deg * std::numbers::pi / 180;
    const Vec2d forward{std::sin(heading), std::cos(heading)}, right{std::cos(heading), -std::sin(heading)};
    // Half the extent of the area in and across the direction of flight.
    const double along_reach =
        0.5 * (std::abs(forward.x) * scene.area_m.x + std::abs(forward.y) * scene.area_m.y) + flight.beyond_area_m;
    const double across_reach =
        0.5 * (std::abs(right.x) * scene.area_m.x + std::abs(right.y) * scene.area_m.y) + flight.beyond_area_m;
    bool outbound = true;
    for (const double across : spread(across_reach, across_spacing)) {
      for (const double step : spread(along_reach, along_spacing)) {
        const double along = outbound ? step : -step;
        const Vec2d below = center + along * forward + across * right;
        const double z = ground ? altitude_m + ground->at(below).z : altitude_m;
        deviations.advance();
        for (const double look_deg : flight.looks_deg)
          poses.push_back(deviations.flown(
              {{below.x, below.y, z}, heading_deg + (outbound ? 0 : 180) + look_deg, -90 + flight.off_nadir_deg, 0}));
      }
      outbound = !outbound;
    }
  }
  return poses;
}

}  // namespace skysweep::scene
