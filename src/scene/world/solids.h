// SPDX-License-Identifier: Apache-2.0
// Everything that stands on the ground, as geometry: boxes, facets (planar polygons) and trees.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/box.h"
#include "core/vec.h"
#include "scene/scene.h"
#include "scene/world/facets.h"
#include "scene/world/ground.h"
#include "scene/world/solid_box.h"
#include "scene/world/town.h"
#include "scene/world/tree_shapes.h"

namespace skysweep::scene {

struct Solids {
  std::vector<SolidBox> boxes{};
  Facets facets{};
  std::vector<TreeInstance> trees{};

  double highest_m() const;  // lowest double if there is nothing
};

// All that may be seen on `extent`. What stands at a place is the same however large the extent is.
Solids build_solids(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets,
                    const Box2d& extent);

// No object reaches higher than this above the highest ground; absolute heights (buildings, decks) count from z = 0.
double tallest_object_m(const Scene& scene);

}  // namespace skysweep::scene
