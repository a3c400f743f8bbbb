// SPDX-License-Identifier: Apache-2.0
// What surfaces look like: how much light of each colour they send back, at every point.
#pragma once

#include <optional>
#include <vector>

#include "core/vec.h"
#include "scene/scene.h"
#include "scene/world/ground_cover.h"
#include "scene/world/linear_rgb.h"
#include "scene/world/tracer.h"

namespace skysweep::scene {

class Materials {
 public:
  // The references must outlive the object.
  Materials(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets, const Solids& solids);

  // Diffuse reflectance, 0 to 1. The point must be on a surface.
  LinearRgb reflectance(const SurfacePoint& point) const;

 private:
  LinearRgb ground(Vec2d p) const;
  LinearRgb top(const SolidBox& box, Vec2d local) const;
  LinearRgb wall(const SolidBox& box, const SurfacePoint& point) const;
  LinearRgb facet(const SurfacePoint& point) const;  // object_materials.cpp
  LinearRgb leaf(const SurfacePoint& point) const;   // likewise

  const std::optional<StreetPlan>& streets_;
  const Solids& solids_;
  std::uint32_t seed_;
  float contrast_;
  double per_finest_;  // 1 / size of the finest detail
  GroundCover cover_;
};

}  // namespace skysweep::scene
