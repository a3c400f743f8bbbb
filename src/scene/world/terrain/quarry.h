// SPDX-License-Identifier: Apache-2.0
// An open pit: a profile of faces and benches, drawn along the distance from a rectangle with round corners.
#pragma once

#include "scene/terrain.h"
#include "scene/world/terrain/profile.h"
#include "scene/world/terrain/surface.h"

namespace skysweep::scene {

class Quarry final : public TerrainSurface {
 public:
  explicit Quarry(const QuarryTerrain& shape);

  HeightSample at(Vec2d p) const override;
  HeightRange heights(const Box2d& box) const override;
  MeshPlan mesh_plan() const override;
  double curvature(const Box2d& box) const override;

 private:
  struct Distance {
    double inward = 0;  // from the rim, positive in the pit
    Vec2d gradient;     // of it, in (u, v)
  };
  Distance distance(Vec2d uv) const;
  Vec2d to_uv(Vec2d p) const;

  QuarryTerrain shape_;
  Profile profile_;  // along `inward`
  Vec2d axis_u_;
};

}  // namespace skysweep::scene
