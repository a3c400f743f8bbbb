// SPDX-License-Identifier: Apache-2.0
#include "scene/flight/clearance.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace skysweep::scene {

bool flies_over_everything(const Flight& flight) {
  return flight.pattern == FlightPattern::strips && !flight.terrain_following;
}

void require_above_surface(const World& world, const std::vector<camera::Pose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3d camera = poses[i].center;
    const Ray down{{camera.x, camera.y, std::max(camera.z, world.highest_m()) + 1}, {0, 0, -1}};
    SurfacePoint surface;
    world.tracer().first_hits(&down, 1, &surface);
    if (surface.face != Face::none && camera.z <= surface.position.z)
      throw usage_error("photograph " + std::to_string(i + 1) + " would be taken at " +
                        std::to_string(std::lround(camera.z)) + " m, below the surface at its place (" +
                        std::to_string(std::lround(surface.position.z)) +
                        " m): raise flight.altitudes_m, or change radius or poses");
  }
}

}  // namespace skysweep::scene
