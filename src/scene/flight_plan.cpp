// SPDX-License-Identifier: Apache-2.0
#include "scene/flight_plan.h"

#include <algorithm>

#include "camera/camera.h"
#include "scene/flight/deviation.h"
#include "scene/flight/patterns.h"
#include "scene/world/ground.h"

namespace skysweep::scene {
namespace {

std::vector<camera::Pose> poses_of(const Scene& scene, const Flight& flight, int number) {
  if (flight.pattern == FlightPattern::given) return flight.poses;
  Deviations deviations(flight, scene.seed, number);
  std::vector<camera::Pose> poses;
  for (const double altitude : flight.resolved_altitudes_m(scene.camera.focal_px())) {
    const std::vector<camera::Pose> level = flight.pattern == FlightPattern::orbit
                                                ? fly_orbit(flight, altitude, deviations)
                                                : fly_strips(scene, flight, altitude, deviations);
    poses.insert(poses.end(), level.begin(), level.end());
  }
  return poses;
}

double highest_altitude_m(const Scene& scene) {
  double highest = 0;
  for (const Flight* flight : scene.flights())
    for (const double altitude : flight->resolved_altitudes_m(scene.camera.focal_px()))
      highest = std::max(highest, altitude);
  return highest;
}

}  // namespace

std::vector<camera::Pose> plan_flight(const Scene& scene) {
  std::vector<camera::Pose> poses;
  int number = 0;
  for (const Flight* flight : scene.flights()) {
    const std::vector<camera::Pose> more = poses_of(scene, *flight, number++);
    poses.insert(poses.end(), more.begin(), more.end());
  }
  return poses;
}

Box2d visible_ground(const Scene& scene, const std::vector<camera::Pose>& poses) {
  constexpr double kFarthest = 6;  // altitudes: ground beyond is sky
  const double farthest_m = kFarthest * highest_altitude_m(scene);
  const Ground ground(scene);
  Box2d box{{0, 0}, scene.area_m};
  // How far they see depends on the heights there, and these on how far they see: on a slope that goes on and on.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const Box2d before = box;
    const HeightRange heights = ground.heights(before);
    for (const camera::Pose& pose : poses)
      for (const Vec2d p : camera::footprint({scene.camera, pose}, heights.lowest - 1, heights.highest, farthest_m))
        box.extend(p);
    const HeightRange seen = ground.heights(box);
    if (seen.lowest >= heights.lowest && seen.highest <= heights.highest) break;
  }
  return box;
}

}  // namespace skysweep::scene
