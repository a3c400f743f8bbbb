// SPDX-License-Identifier: Apache-2.0
// Buildings whose roof is not simply level: gable, hip, shed and saw-tooth roofs without overhang, and courtyards.
#pragma once

#include <optional>

#include "scene/objects.h"
#include "scene/world/facets.h"

namespace skysweep::scene {

// In the building's own frame (u, v from its centre; half sides a and b), the height of the roof above the eaves, as
// a share of `ridge_z` - eaves, is
//   gable  1 - |v| / b, hip  min((b - |v|) / b, (a - |u|) / b), both with u along the longer side
//   shed   (v + b) / 2b
//   saw_tooth  t / r where t < r, else (w - t) / (w - r): w = 2b / teeth, t = v + b modulo w, r = w - height of the
//     teeth / tan(steep_deg). All teeth look exactly alike: that they do is what matching stumbles over
//   gable around a courtyard: 0 at outer and inner walls, 1 halfway between them
struct RoofedBuilding {
  SolidBox walls;  // z_high: the eaves
  RoofKind roof = RoofKind::gable;
  double ridge_z = 0;                     // not used by a flat roof
  std::optional<Vec2d> courtyard_half{};  // half sides of the hole; flat and gable only
  int teeth = 1;                          // saw_tooth only
  double steep_deg = 90;                  // likewise
};
void add_building(Facets& facets, const RoofedBuilding& building);

}  // namespace skysweep::scene
