// SPDX-License-Identifier: Apache-2.0
// Heights on a lattice, joined by Catmull-Rom bicubic patches: through every height, with a continuous slope.
// Source: Catmull & Rom 1974; Keys 1981 (a = -1/2).
#pragma once

#include <vector>

#include "core/array2d.h"
#include "scene/world/terrain/surface.h"

namespace skysweep::scene {

class HeightGrid final : public TerrainSurface {
 public:
  enum class Beyond { border, zero };  // what lies around the lattice: its outermost heights, or none

  // `heights` with row 0 in the south; (0, 0) lies at `first`, neighbours `spacing` apart in x and y.
  HeightGrid(const Array2d<double>& heights, Vec2d first, Vec2d spacing, Beyond beyond);

  HeightSample at(Vec2d p) const override;
  HeightRange heights(const Box2d& box) const override;
  MeshPlan mesh_plan() const override;
  double curvature(const Box2d& box) const override;  // (u, v) = (x, y)

  // Where it may differ from what lies beyond.
  Box2d extent() const;

 private:
  static constexpr int kRim = 3;  // further rows and columns all round

  struct Place {
    int index = 0;  // of the patch, which lies between lattice points index and index + 1
    double t = 0;   // within the patch
    bool beyond = false;
  };
  Place place(double lattice_units, int count) const;
  double patch_curvature(int i, int j) const;

  Array2d<double> heights_;   // with the rim
  Array2d<float> curvature_;  // of each patch, rounded up
  Vec2d first_, spacing_;     // of the rim's corner
  HeightRange range_;
};

}  // namespace skysweep::scene
