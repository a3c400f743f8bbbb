// SPDX-License-Identifier: Apache-2.0
#include "sweep/visibility.h"

#include <algorithm>
#include <cmath>

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

}  // namespace skysweep::sweep
