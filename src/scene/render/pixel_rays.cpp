// SPDX-License-Identifier: Apache-2.0
#include "scene/render/pixel_rays.h"

#include <cmath>
#include <limits>

namespace skysweep::scene {

PixelRays::PixelRays(const camera::CameraModel& model) : model_(model) {
  if (model.distortion.none()) return;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  corners_ = Array2d<Vec2d>(model.width_px + 1, model.height_px + 1);
  for (int row = 0; row < corners_.height(); ++row)
    for (int column = 0; column < corners_.width(); ++column)
      corners_(column, row) =
          camera::undistort(model.distortion, normalised({1.0 * column, 1.0 * row})).value_or(Vec2d{kNaN, kNaN});
}

Vec2d PixelRays::normalised(Vec2d pixel) const {
  return {(pixel.x - model_.cx_px) / model_.fx_px, (pixel.y - model_.cy_px) / model_.fy_px};
}

bool PixelRays::valid(int column, int row) const {
  if (corners_.empty()) return true;
  const Vec2d sum =
      corners_(column, row) + corners_(column + 1, row) + corners_(column, row + 1) + corners_(column + 1, row + 1);
  return std::isfinite(sum.x + sum.y);
}

Vec3d PixelRays::direction(int column, int row, Vec2d within) const {
  if (corners_.empty()) {
    const Vec2d n = normalised({column + within.x, row + within.y});
    return {n.x, n.y, 1};
  }
  const Vec2d top = (1 - within.x) * corners_(column, row) + within.x * corners_(column + 1, row);
  const Vec2d bottom = (1 - within.x) * corners_(column, row + 1) + within.x * corners_(column + 1, row + 1);
  const Vec2d n = (1 - within.y) * top + within.y * bottom;
  return {n.x, n.y, 1};
}

}  // namespace skysweep::scene
