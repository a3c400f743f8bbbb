// SPDX-License-Identifier: Apache-2.0
// What a surface is, for figures of accuracy by class. docs/formats.md names the codes: they are those of
// truth/classes.tif.
#pragma once

#include <cstdint>

#include "scene/world/tracer.h"

namespace skysweep::scene {

enum class SurfaceClass : std::uint8_t {
  none = 0,
  ground = 1,       // with the cars on it
  roof = 2,         // of buildings, with what stands on it; decks and ramps of bridges
  facade_edge = 3,  // facades; in the class map also ground and roof close to a height step of a building
  tree = 4,
  water = 5,
  thin = 6,  // walls, masts, wires
};

SurfaceClass class_of(const SurfacePoint& point, const Solids& solids);

}  // namespace skysweep::scene
