// SPDX-License-Identifier: Apache-2.0
// Where the pixels of a camera look, in the camera's frame: worked out once, used for all its photographs.
#pragma once

#include <array>

#include "camera/camera_model.h"
#include "core/array2d.h"
#include "core/vec.h"

namespace skysweep::scene {

class PixelRays {
 public:
  explicit PixelRays(const camera::CameraModel& model);

  // Camera-frame direction (z = 1) of a position within pixel (column, row); `within` from (0, 0), its top-left
  // corner, to (1, 1). With distortion the inverse of the lens model is interpolated between the pixel's corners: good
  // to 5e-4 pixels even for a strong wide-angle lens.
  Vec3d direction(int column, int row, Vec2d within) const;

  // Whether the lens model has an inverse at all four corners of the pixel.
  bool valid(int column, int row) const;

 private:
  Vec2d normalised(Vec2d pixel) const;

  camera::CameraModel model_;
  Array2d<Vec2d> corners_;  // undistorted normalised coordinates; empty without distortion
};

}  // namespace skysweep::scene
