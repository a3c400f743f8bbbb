// SPDX-License-Identifier: Apache-2.0
// What a kind of ground has to tell: its height and slope at a point, and bounds that let a ray find it exactly.
#pragma once

#include <vector>

#include "core/box.h"
#include "core/vec.h"

namespace skysweep::scene {

struct HeightSample {
  double z = 0;
  Vec2d slope;  // dz/dx, dz/dy
};

struct HeightRange {
  double lowest = 0, highest = 0;
};

// Where a mesh of the ground has to have its lines. u runs along `axis_u`, v is turned left from it.
struct MeshPlan {
  Vec2d axis_u{1, 0};
  double spacing_m = 1e9;         // of the lines, at most
  std::vector<double> u_creases;  // the ground has edges along u = const here: lines must lie on them
};

// A surface z(x, y), continuous, with a slope that is continuous but for the creases it names. Immutable.
class TerrainSurface {
 public:
  virtual ~TerrainSurface() = default;
  virtual HeightSample at(Vec2d p) const = 0;
  // Between which all heights on `box` (x, y) lie.
  virtual HeightRange heights(const Box2d& box) const = 0;
  virtual MeshPlan mesh_plan() const { return {}; }
  // Bound on the second derivative of the height in any direction, anywhere in `box`, which is given in (u, v) of the
  // mesh plan and is crossed by no crease. 1/m.
  virtual double curvature(const Box2d& box) const = 0;
};

}  // namespace skysweep::scene
