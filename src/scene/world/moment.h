// SPDX-License-Identifier: Apache-2.0
// What of the world belongs to one moment: its light, and what passes by. The world itself holds the moment of a scene
// without effects.
#pragma once

#include <memory>

#include "scene/world/materials.h"
#include "scene/world/tracer.h"

namespace skysweep::scene {

// Takes light from the sun on its way down. Safe to call from several threads.
class SunFilter {
 public:
  virtual ~SunFilter() = default;
  // Multiplies sun[i] by the part of the sun's light that reaches hits[i].
  virtual void dim(const SurfacePoint* hits, int count, Vec3d towards_sun, float* sun) const = 0;
};

// Solids that stand here only now. Safe to call from several threads.
class PassingSolids {
 public:
  virtual ~PassingSolids() = default;
  // Where one is hit before hits[i]: sets hits[i], its reflectance own[i] and passing[i].
  virtual void first_hits(const Ray* rays, int count, SurfacePoint* hits, LinearRgb* own, bool* passing) const = 0;
  // Sets out[i] where one lies on the endless way of an active ray.
  virtual void blocked(const Ray* rays, const bool* active, int count, bool* out) const = 0;
};

struct Moment {
  Vec3d towards_sun{0, 0, 1};  // unit vector
  LinearRgb sun, sky;          // light of either on level ground
  std::shared_ptr<const SunFilter> clouds;
  std::shared_ptr<const PassingSolids> traffic;
};

}  // namespace skysweep::scene
