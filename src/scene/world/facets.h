// SPDX-License-Identifier: Apache-2.0
// Planar facets: roofs that are not level, decks, walls, masts, wires. A ray meets a facet exactly where it meets the
// facet's plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "scene/world/solid_box.h"

namespace skysweep::scene {

enum class BodyKind { building, glazing, wall, bridge, mast, wire };  // glazing: of a saw-tooth roof

// What a facet is part of. `place` is the frame of its colours: centre, axes, height of the eaves, seed.
struct Body {
  BodyKind kind = BodyKind::building;
  SolidBox place;
};

struct Facet {
  std::array<Vec3d, 4> corner;  // counter-clockwise from outside; a triangle repeats its last
  Vec3d normal;                 // unit, outwards; exactly vertical if the corners are level
  int body = 0;                 // index into Facets::bodies
  int face = 0;                 // which face of the body: facets of one plane share it
};

struct Facets {
  std::vector<Facet> all{};
  std::vector<Body> bodies{};

  int add_body(const Body& body);
  // A convex planar polygon, counter-clockwise from outside; corners that repeat are dropped, and nothing is added
  // where fewer than three are left.
  void add_polygon(const std::vector<Vec3d>& corners, int body, int face);
};

// A straight beam: upright sides and ends, plane top and underside that may slope along it.
struct Beam {
  Vec2d from, to;
  double width_m = 1;
  double top_from = 0, top_to = 0;        // heights at the two ends
  double bottom_from = 0, bottom_to = 0;  // below the top
};
void add_beam(Facets& facets, const Beam& beam, int body);

}  // namespace skysweep::scene
