// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/shots.h"

#include <cmath>

namespace skysweep::scene {
namespace {

// Unit vector from pose i to the next; zero where there is none.
Vec3d leg(const std::vector<camera::Pose>& poses, int i) {
  if (i < 0 || i + 1 >= static_cast<int>(poses.size())) return {};
  const auto at = static_cast<std::size_t>(i);
  const Vec3d way = poses[at + 1].center - poses[at].center;
  return norm(way) > 0 ? normalized(way) : Vec3d{};
}

Vec3d direction_of_flight(const std::vector<camera::Pose>& poses, int i) {
  const Vec3d before = leg(poses, i - 1), after = leg(poses, i);
  if (norm(before) == 0) return after;
  if (norm(after) == 0) return before;
  constexpr double kTurn = 0.5;  // cosine: legs that differ more are not of one strip
  if (dot(before, after) > kTurn) return normalized(before + after);
  return dot(leg(poses, i - 2), before) >= dot(after, leg(poses, i + 1)) ? before : after;
}

}  // namespace

std::vector<Shot> shots_of(const std::vector<camera::Pose>& poses, double speed_mps) {
  std::vector<Shot> out;
  double way_m = 0;
  for (int i = 0; i < static_cast<int>(poses.size()); ++i) {
    const camera::Pose& pose = poses[static_cast<std::size_t>(i)];
    if (i > 0) way_m += norm(pose.center - out.back().pose.center);
    out.push_back({i, way_m / speed_mps, pose, speed_mps * direction_of_flight(poses, i)});
  }
  return out;
}

}  // namespace skysweep::scene
