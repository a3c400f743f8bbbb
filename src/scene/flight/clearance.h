// SPDX-License-Identifier: Apache-2.0
// Whether a flight keeps clear of what it photographs.
#pragma once

#include <vector>

#include "camera/pose.h"
#include "scene/scene.h"
#include "scene/world/world.h"

namespace skysweep::scene {

// Level strips fly over everything; an orbit, a flight along the terrain and given poses may pass beside what is
// higher.
bool flies_over_everything(const Flight& flight);

// Throws Error(usage), naming the first photograph that would be taken inside or below the surface at its place.
void require_above_surface(const World& world, const std::vector<camera::Pose>& poses);

}  // namespace skysweep::scene
