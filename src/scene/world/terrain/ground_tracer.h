// SPDX-License-Identifier: Apache-2.0
// Rays against ground of any shape, exactly: the first point of the closed form on the ray, however steep or rough.
//
// Embree sees a mesh that is raised until it lies nowhere below the ground, by as little as the curvature of the ground
// in each cell allows. A ray cannot reach the ground before that mesh. From there on it is followed through the cells
// of the mesh with Newton steps that are shortened by the same bound on the curvature, so that none passes a root; if
// it comes out above the mesh again, Embree goes on from there. The water's level plane is met in closed form.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/array2d.h"
#include "core/box.h"
#include "scene/world/ground.h"
#include "scene/world/ray.h"

namespace skysweep::scene {

// Immutable after construction: safe to share between threads.
class GroundTracer {
 public:
  // `ground` must outlive the tracer. It is there on `extent` (and a little beyond, if its mesh is turned).
  GroundTracer(const Ground& ground, const Box2d& extent);
  ~GroundTracer();
  GroundTracer(const GroundTracer&) = delete;
  GroundTracer& operator=(const GroundTracer&) = delete;

  struct Hit {
    double t = 0;  // position = origin + t x direction
    bool water = false;
  };
  // First hit of each active ray with t in [0, reach]. count <= kRayBatch.
  void first_hits(const Ray* rays, const bool* active, int count, double reach, std::optional<Hit>* hits) const;

 private:
  struct Embree;
  struct Cell {
    int column = 0, row = 0;
  };
  enum class End { hit, above, outside };
  struct Walk {
    End end = End::outside;
    double t = 0;
  };

  void build_mesh();
  Vec2d to_uv(Vec2d p) const { return {dot(p, axis_u_), cross(axis_u_, p)}; }
  std::optional<Cell> cell_at(Vec2d uv) const;
  // Where a ray comes over the mesh; 0 if it starts there.
  std::optional<double> enters(const Ray& ray) const;
  // Whether it is so low there that it may be below the raised mesh.
  bool near_ground(const Ray& ray, double t) const;
  // Follows a ray from `t` on until it meets the ground, is clearly above the mesh (from `mesh_t` on), or has left it
  // or passed `reach`.
  Walk walk(const Ray& ray, double t, double mesh_t, double reach) const;
  // The last root before `t`, where the ray is below the ground by a rounding error.
  double step_back_to_root(const Ray& ray, double t) const;
  // First root of a ray that meets the mesh at `mesh_t`.
  std::optional<double> from_mesh(const Ray& ray, double mesh_t, double reach) const;
  std::optional<double> next_on_mesh(const Ray& ray, double from, double reach) const;
  std::optional<Hit> water_on(const Ray& ray, double reach) const;

  const Ground& ground_;
  Vec2d axis_u_;
  std::vector<double> u_lines_, v_lines_;
  Array2d<float> band_;  // of each cell: how far the raised mesh lies above the ground at most, metres
  Array2d<float> curvature_;
  double highest_m_ = 0, widest_band_m_ = 0, slack_m_ = 0;
  std::unique_ptr<Embree> embree_;
};

}  // namespace skysweep::scene
