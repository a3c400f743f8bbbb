// SPDX-License-Identifier: Apache-2.0
// Where the photographs of a scene are taken.
#pragma once

#include <vector>

#include "camera/pose.h"
#include "core/box.h"
#include "scene/scene.h"

namespace skysweep::scene {

// Poses in the scene's frame, in the order of flight; positions are snapped.
std::vector<camera::Pose> plan_flight(const Scene& scene);

// The mapped area and everything the photographs see of the ground around it, as far as the horizon is cut off.
Box2d visible_ground(const Scene& scene, const std::vector<camera::Pose>& poses);

}  // namespace skysweep::scene
