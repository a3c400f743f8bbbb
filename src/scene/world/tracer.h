// SPDX-License-Identifier: Apache-2.0
// Rays against ground, boxes, facets and trees. Embree finds in single precision what is hit; where, is then computed
// in double from the closed form of the ground or the plane of the face, facet or leaf, so that the truth does not
// depend on Embree's precision or the mesh.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "core/box.h"
#include "core/vec.h"
#include "scene/world/ground.h"
#include "scene/world/ray.h"
#include "scene/world/solids.h"
#include "scene/world/terrain/ground_tracer.h"

namespace skysweep::scene {

enum class Face { none, ground, top, wall, leaf, water };  // top and wall: of a box or facet

struct SurfacePoint {
  Face face = Face::none;
  int box = -1;              // index of the box hit, or -1
  int facet = -1;            // of the facet
  int tree = -1, leaf = -1;  // of the tree, and of the leaf of its prototype
  Vec3d position;
  Vec3d normal;  // unit, outwards
};

// Immutable after construction: safe to share between threads.
class Tracer {
 public:
  static constexpr int kBatch = kRayBatch;

  // `ground` and `solids` must outlive the tracer. Ground is there on `extent` only.
  Tracer(const Ground& ground, const Solids& solids, const Box2d& extent);
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
  // Puts the ground (or water) into the place of what lies behind it.
  void meet_shaped_ground(const Ray* rays, int count, SurfacePoint* hits) const;
  // `met`: how far along the ray, as Embree found.
  void hit_facet(const Ray& ray, float met, SurfacePoint& hit) const;
  void hit_leaf(const Ray& ray, float met, SurfacePoint& hit) const;
  void attach_trees();

  const Ground& ground_;
  const Solids& solids_;
  std::array<std::vector<Leaf>, kTreePrototypes> prototypes_;  // those that some tree is of
  std::unique_ptr<Embree> embree_;
  std::unique_ptr<GroundTracer> ground_tracer_;  // of ground that is not plain; without it the ground is in embree_
};

}  // namespace skysweep::scene
