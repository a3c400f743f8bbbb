// SPDX-License-Identifier: Apache-2.0
#include "sweep/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::sweep {
SurfaceVisibility::SurfaceVisibility(const Grid& grid, const Array2d<float>& height_m, double tolerance_m)
    : grid_(grid), height_m_(height_m), tolerance_m_(tolerance_m), maxima_(height_m), highest_(maxima_.highest()) {}

bool SurfaceVisibility::sees(Vec3d eye, int column, int row, double z) const {
  // One step moves one cell along the longer of the two grid axes; the nearest cell is tested at each step.
  const Vec2d cell = grid_.cell_center(column, row);
  const double dx = (eye.x - cell.x) / grid_.cell_m, dy = (cell.y - eye.y) / grid_.cell_m;
  const double steps = std::max(std::abs(dx), std::abs(dy));
  if (steps < 1) return true;
  const double step_x = dx / steps, step_y = dy / steps, step_z = (eye.z - z) / steps;
  if (step_z <= 0) return false;  // the camera is below the cell
  const int last = static_cast<int>(std::clamp(std::ceil((highest_ - tolerance_m_ - z) / step_z), 0.0, steps));
  const BlockExit exit(step_x, step_y);
  for (int i = 1; i <= last;) {
    const int x = rounded(column + i * step_x), y = rounded(row + i * step_y);
    if (!height_m_.contains(x, y)) return true;
    const double limit = z + i * step_z + tolerance_m_;
    // The ray only rises: nothing in a block that ends below it can hide the cell.
    const int clear = maxima_.clear_cells(x, y, [limit](float highest) { return highest <= limit; });
    if (clear > 0) {
      i += exit.steps(clear, x, y);
      continue;
    }
    if (height_m_(x, y) > limit) return false;  // never of NaN
    ++i;
  }
  return true;
}

double SurfaceVisibility::lowest_visible(Vec3d eye, int column, int row, double z) const {
  const Vec2d cell = grid_.cell_center(column, row);
  const double dx = (eye.x - cell.x) / grid_.cell_m, dy = (cell.y - eye.y) / grid_.cell_m;
  const double steps = std::max(std::abs(dx), std::abs(dy));
  if (steps < 1) return z;
  if (eye.z <= z) return std::numeric_limits<double>::infinity();
  const BlockExit exit(dx / steps, dy / steps);
  for (int i = 1; i <= steps;) {
    const double t = i / steps, line = z + t * (eye.z - z);
    const int x = rounded(column + t * dx), y = rounded(row + t * dy);
    if (highest_ - tolerance_m_ <= line || !height_m_.contains(x, y)) return z;
    const double limit = line + tolerance_m_;
    const int clear = maxima_.clear_cells(x, y, [limit](float highest) { return highest <= limit; });
    if (clear > 0) {
      i += exit.steps(clear, x, y);
      continue;
    }
    const float height = height_m_(x, y);
    // A line from (cell, z) passes step i at z + t (eye.z - z): the z with which it just clears this height.
    if (height > limit) z = t < 1 ? (height - tolerance_m_ - t * eye.z) / (1 - t) : eye.z;  // never of NaN
    ++i;
  }
  return z;
}

}  // namespace skysweep::sweep
