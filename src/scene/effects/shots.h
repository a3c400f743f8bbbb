// SPDX-License-Identifier: Apache-2.0
// When the photographs of a flight are taken and how fast the camera moves then.
#pragma once

#include <vector>

#include "scene/effects/effect.h"

namespace skysweep::scene {

// The aircraft flies straight from pose to pose with constant speed. Velocity points along the leg before or after a
// photograph, whichever of the two goes on more nearly straight: at the ends of a strip that is the strip's.
std::vector<Shot> shots_of(const std::vector<camera::Pose>& poses, double speed_mps);

}  // namespace skysweep::scene
