// SPDX-License-Identifier: Apache-2.0
// The scene, ready to be looked at: geometry, materials and light in one.
#pragma once

#include <optional>
#include <vector>

#include "core/box.h"
#include "scene/scene.h"
#include "scene/world/ground.h"
#include "scene/world/materials.h"
#include "scene/world/moment.h"
#include "scene/world/solids.h"
#include "scene/world/surface_class.h"
#include "scene/world/town.h"
#include "scene/world/tracer.h"

namespace skysweep::scene {

// Immutable but for set_moment: safe to share between threads.
class World {
 public:
  // Everything that can be seen on `visible`, a box on the ground.
  World(const Scene& scene, const Box2d& visible);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Tracer& tracer() const { return tracer_; }
  // Heights between which all surfaces lie.
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }
  // Of the bare ground, or of the water that stands on it.
  double ground_m(Vec2d p) const { return ground_.surface_m(p); }

  const Solids& solids() const { return solids_; }
  SurfaceClass surface_class(const SurfacePoint& point) const { return class_of(point, solids_); }

  // Light that comes back along each of `count` <= Tracer::kBatch rays (1: white, lit like level ground in the sun),
  // and what they hit first.
  void look(const Ray* rays, int count, SurfacePoint* hits, LinearRgb* light) const {
    look(rays, count, hits, light, moment_);
  }
  // The same at another moment.
  void look(const Ray* rays, int count, SurfacePoint* hits, LinearRgb* light, const Moment& moment) const;

  const Moment& moment() const { return moment_; }
  void set_moment(const Moment& moment) { moment_ = moment; }  // before the world is shared

 private:
  Ground ground_;
  std::optional<StreetPlan> streets_;
  Solids solids_;
  Tracer tracer_;
  Materials materials_;
  Moment moment_;
  bool textured_, shadows_;
  double lowest_m_, highest_m_;
};

}  // namespace skysweep::scene
