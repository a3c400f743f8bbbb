// SPDX-License-Identifier: Apache-2.0
// Rays against ground and boxes. Embree finds in single precision what is hit; where, is then computed in double from
// the closed form of the face or the ground, so that the truth does not depend on Embree's precision or the mesh.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/box.h"
#include "core/vec.h"
#include "scene/world/ground.h"
#include "scene/world/town.h"

namespace skysweep::scene {

struct Ray {
  Vec3d origin;
  Vec3d direction;  // of any length but zero
};

enum class Face { none, ground, top, wall };

struct SurfacePoint {
  Face face = Face::none;
  int box = -1;  // index of the box hit, or -1
  Vec3d position;
  Vec3d normal;  // unit, outwards
};

// Immutable after construction: safe to share between threads.
class Tracer {
 public:
  static constexpr int kBatch = 16;  // rays that are traced together

  // `ground` and `boxes` must outlive the tracer. Ground is there on `extent` only.
  Tracer(const Ground& ground, const std::vector<SolidBox>& boxes, const Box2d& extent);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // First surface along each of `count` <= kBatch rays.
  void first_hits(const Ray* rays, int count, SurfacePoint* hits) const;

  // Whether something lies on the way from origin to origin + direction x (1, or infinity if `endless`); rays with
  // active[i] false are passed over. count <= kBatch.
  void blocked(const Ray* rays, const bool* active, int count, bool endless, bool* out) const;

  // For measuring: traces the rays with Embree alone each time it is called, without working out where they hit, and
  // gives back how many hit something. The packets are prepared now. The tracer must outlive it.
  std::function<int()> embree_alone(const std::vector<Ray>& rays) const;

 private:
  struct Embree;
  const Ground& ground_;
  const std::vector<SolidBox>& boxes_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace skysweep::scene
