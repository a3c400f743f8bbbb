// SPDX-License-Identifier: Apache-2.0
// What is long or thin, made of beams: walls, bridges, masts, power lines.
#pragma once

#include "scene/objects.h"
#include "scene/world/facets.h"
#include "scene/world/ground.h"

namespace skysweep::scene {

// In pieces of at most two metres, each with its ends at the wall's height above the ground.
void add_wall(Facets& facets, const FreeWall& wall, const Ground& ground);

// The deck is a body of its own; so is each ramp, which reaches the ground at its end.
void add_bridge(Facets& facets, const Bridge& bridge, const Ground& ground);

void add_mast(Facets& facets, const Mast& mast, const Ground& ground);

// Wires are square in section, flat side up, and hang in parabolas made of kWirePieces straight pieces: the middle of a
// wire lies 4 sag t (1 - t) below the straight line, t from 0 to 1 between two pylons.
constexpr int kWirePieces = 24;
void add_power_line(Facets& facets, const PowerLine& line, const Ground& ground);

}  // namespace skysweep::scene
