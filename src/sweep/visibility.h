// SPDX-License-Identifier: Apache-2.0
// Which cells of a surface a camera sees past the rest of the surface. Knows the grid only: what stands outside it
// hides nothing, which is why tiles are swept with a collar.
#pragma once

#include "core/array2d.h"
#include "core/vec.h"
#include "sweep/block_maxima.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

class SurfaceVisibility {
 public:
  // `height_m`: NaN cells hide nothing. The surface must outlive this object. `tolerance_m`: the surface must rise
  // above the ray by more than this to hide a cell, so that noise does not.
  SurfaceVisibility(const Grid& grid, const Array2d<float>& height_m, double tolerance_m);

  // Whether the straight line from the cell's centre at height z up to `eye` stays above the surface.
  bool sees(Vec3d eye, int column, int row, double z) const;

  // The lowest height, from z on, from which it does; +infinity where the camera is no higher than z.
  double lowest_visible(Vec3d eye, int column, int row, double z) const;

 private:
  Grid grid_;
  const Array2d<float>& height_m_;
  double tolerance_m_;
  BlockMaxima maxima_;
  float highest_;
};

}  // namespace skysweep::sweep
