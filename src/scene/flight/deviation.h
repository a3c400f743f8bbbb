// SPDX-License-Identifier: Apache-2.0
// From the pose that was planned to the one that was flown.
#pragma once

#include <cstdint>

#include "camera/pose.h"
#include "core/random.h"
#include "scene/flight.h"
#include "scene/flight/drift.h"

namespace skysweep::scene {

struct PlannedPose {
  Vec3d position;
  double yaw_deg = 0, pitch_deg = -90, roll_deg = 0;  // camera/pose.h
};

// One draw for each position of the flight, whether used or not, so that one kind of deviation does not change another.
// All photographs taken at one position deviate alike: they come from one rig.
class Deviations {
 public:
  // `number`: 0 for the first flight of the scene, whose scatter must stay what it always was.
  Deviations(const Flight& flight, std::uint64_t scene_seed, int number);

  // Draws for the next position.
  void advance();
  camera::Pose flown(const PlannedPose& planned) const;

 private:
  const Flight& flight_;
  Random scatter_;
  Drift drift_;
  Vec3d offset_, turn_;
  Drift::Deviation drifted_;
};

}  // namespace skysweep::scene
