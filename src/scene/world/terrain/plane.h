// SPDX-License-Identifier: Apache-2.0
// A tilted plane.
#pragma once

#include "scene/terrain.h"
#include "scene/world/terrain/surface.h"

namespace skysweep::scene {

class TiltedPlane final : public TerrainSurface {
 public:
  explicit TiltedPlane(const PlaneTerrain& shape);
  HeightSample at(Vec2d p) const override;
  HeightRange heights(const Box2d& box) const override;
  double curvature(const Box2d&) const override { return 0; }

 private:
  Vec2d slope_;
  double z_of_origin_m_;
};

}  // namespace skysweep::scene
