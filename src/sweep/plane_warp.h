// SPDX-License-Identifier: Apache-2.0
// A photograph seen in the frame of another one by way of horizontal planes: what the depth probe compares.
#pragma once

#include <vector>

#include "core/array2d.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Pixels of a pyramid level of a photograph, and where their rays go.
struct PixelRays {
  PixelRays(const View& view, int level);

  int level = 0, width = 0, height = 0;
  Vec3d center;  // of projection
  // Of each pixel, row-major: metres east and north for each metre down; NaN where the ray does not lead down.
  std::vector<double> east, north;
};

// A neighbour's photograph as it appears in the reference's pixels if all they show lay in one horizontal plane. A
// pixel's ray is turned into the neighbour's frame once, not for each plane.
class PlaneWarp {
 public:
  // `reference` and the neighbour's image must outlive this object.
  PlaneWarp(const PixelRays& reference, const View& neighbour);

  // Writes the neighbour's luminance (grey levels) for the plane `depth_m` below the reference's centre of projection
  // into `out`, of the reference's size; NaN where the neighbour does not show it. As Camera::at_height and
  // Camera::project would place it, to rounding.
  void warp(double depth_m, Array2d<float>& out);

 private:
  void place_row(int row, double depth_m);

  const PixelRays& reference_;
  const LuminanceLevel& luminance_;
  camera::CameraModel model_;
  double fold_radius_squared_;
  double scale_;                      // from full-resolution pixels to those of the level
  Vec3d center_;                      // of the reference, in the neighbour's camera frame
  std::vector<double> x_, y_, z_;     // there, the way of each pixel's ray for each metre down
  std::vector<double> column_, row_;  // positions at the level for one row of pixels; negative = not shown
};

}  // namespace skysweep::sweep
