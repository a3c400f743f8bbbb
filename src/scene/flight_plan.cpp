// SPDX-License-Identifier: Apache-2.0
#include "scene/flight_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/camera.h"
#include "core/random.h"
#include "scene/world/ground.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kFlightStream = 0xf1;

// Positions from -reach to reach, not further apart than `spacing`; one in the middle if there is no reach.
std::vector<double> spread(double reach, double spacing) {
  if (!(reach > 0)) return {0};
  const int intervals = std::max(1, static_cast<int>(std::ceil(2 * reach / spacing - 1e-9)));
  std::vector<double> out;
  for (int i = 0; i <= intervals; ++i) out.push_back(-reach + 2 * reach * i / intervals);
  return out;
}

}  // namespace

std::vector<camera::Pose> plan_flight(const Scene& scene) {
  const Flight& flight = scene.flight;
  const double heading = flight.heading_deg * std::numbers::pi / 180;
  const Vec2d forward{std::sin(heading), std::cos(heading)}, right{std::cos(heading), -std::sin(heading)};
  const Vec2d center = 0.5 * scene.area_m;
  // Half the extent of the area in and across the direction of flight.
  const double along_reach =
      0.5 * (std::abs(forward.x) * scene.area_m.x + std::abs(forward.y) * scene.area_m.y) + flight.beyond_area_m;
  const double across_reach =
      0.5 * (std::abs(right.x) * scene.area_m.x + std::abs(right.y) * scene.area_m.y) + flight.beyond_area_m;
  const double along_spacing = (1 - flight.along_overlap) * scene.camera.height_px * flight.gsd_m;
  const double across_spacing = (1 - flight.across_overlap) * scene.camera.width_px * flight.gsd_m;

  Random random(mix64(scene.seed) ^ kFlightStream);
  std::vector<camera::Pose> poses;
  bool outbound = true;
  for (const double across : spread(across_reach, across_spacing)) {
    for (const double step : spread(along_reach, along_spacing)) {
      const double along = outbound ? step : -step;
      const Vec2d ground = center + along * forward + across * right;
      // Drawn whether used or not, so that one kind of scatter does not change the other.
      const Vec3d offset{random.normal(), random.normal(), random.normal()};
      const Vec3d turn{random.normal(), random.normal(), random.normal()};
      const double yaw = flight.heading_deg + (outbound ? 0 : 180) + 2 * flight.tilt_sigma_deg * turn.x;
      const double pitch = -90 + flight.off_nadir_deg + flight.tilt_sigma_deg * turn.y;
      const double roll = flight.tilt_sigma_deg * turn.z;
      const Vec3d position = Vec3d{ground.x, ground.y, scene.altitude_m()} + flight.position_sigma_m * offset;
      poses.push_back({camera::rotation_from_yaw_pitch_roll(yaw, pitch, roll), camera::snap_position(position)});
    }
    outbound = !outbound;
  }
  return poses;
}

Box2d visible_ground(const Scene& scene, const std::vector<camera::Pose>& poses) {
  constexpr double kFarthest = 6;  // altitudes: ground beyond is sky
  const Ground ground(scene);
  Box2d box{{0, 0}, scene.area_m};
  // How far they see depends on the heights there, and these on how far they see: on a slope that goes on and on.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const Box2d before = box;
    const HeightRange heights = ground.heights(before);
    for (const camera::Pose& pose : poses)
      for (const Vec2d p :
           camera::footprint({scene.camera, pose}, heights.lowest - 1, heights.highest, kFarthest * scene.altitude_m()))
        box.extend(p);
    const HeightRange seen = ground.heights(box);
    if (seen.lowest >= heights.lowest && seen.highest <= heights.highest) break;
  }
  return box;
}

}  // namespace skysweep::scene
