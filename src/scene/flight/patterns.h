// SPDX-License-Identifier: Apache-2.0
// The poses of one flight, pattern by pattern, in the order they are flown; positions are snapped.
#pragma once

#include <vector>

#include "camera/pose.h"
#include "scene/flight/deviation.h"
#include "scene/scene.h"

namespace skysweep::scene {

// Strips over the mapped area at one altitude; with cross-strips both sets.
std::vector<camera::Pose> fly_strips(const Scene& scene, const Flight& flight, double altitude_m,
                                     Deviations& deviations);

// One circle at one altitude, clockwise from north of the target.
std::vector<camera::Pose> fly_orbit(const Flight& flight, double altitude_m, Deviations& deviations);

}  // namespace skysweep::scene
