// SPDX-License-Identifier: Apache-2.0
#include "sweep/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

// Of blocks of 2^shift x 2^shift values the largest that is known.
Array2d<float> block_maxima(const Array2d<float>& values, int shift) {
  const auto blocks = [shift](int cells) { return ((cells - 1) >> shift) + 1; };
  Array2d<float> maxima(blocks(values.width()), blocks(values.height()), kNothing);
  for (int row = 0; row < values.height(); ++row) {
    const float* from = values.row(row);
    float* to = maxima.row(row >> shift);
    for (int column = 0; column < values.width(); ++column)
      if (from[column] > to[column >> shift]) to[column >> shift] = from[column];  // never of NaN
  }
  return maxima;
}

// As std::lround, without a call; for numbers that an int can hold.
int rounded(double value) {
  const int whole = static_cast<int>(value);
  const double rest = value - whole;
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

// Steps that a ray may take at once and still lie in its block of `size` cells or, after the last of them, in the first
// one beyond. `position` on the axis along which a step moves one cell, `other` on the other one, along which it takes
// `steps_per_cell`.
struct BlockExit {
  bool forwards, other_forwards;
  double steps_per_cell;

  // Infinitely many steps a cell: a ray along the axis never leaves sideways (no room times infinity is NaN, and
  // std::min then keeps the other).
  int steps(int size, int position, int other) const {
    position &= size - 1;
    other &= size - 1;
    const int room = forwards ? size - position : position + 1;
    const int other_room = other_forwards ? size - 1 - other : other;
    return std::max(1, static_cast<int>(std::min<double>(room, other_room * steps_per_cell)));
  }
};

}  // namespace

SurfaceVisibility::SurfaceVisibility(const Grid& grid, const Array2d<float>& height_m, double tolerance_m)
    : grid_(grid),
      height_m_(height_m),
      tolerance_m_(tolerance_m),
      coarse_max_(block_maxima(height_m, kCoarse)),
      fine_max_(block_maxima(height_m, kFine)),
      highest_(*std::max_element(coarse_max_.begin(), coarse_max_.end())) {}

bool SurfaceVisibility::sees(Vec3d eye, int column, int row, double z) const {
  // One step moves one cell along the longer of the two grid axes; the nearest cell is tested at each step.
  const Vec2d cell = grid_.cell_center(column, row);
  const double dx = (eye.x - cell.x) / grid_.cell_m, dy = (cell.y - eye.y) / grid_.cell_m;
  const double steps = std::max(std::abs(dx), std::abs(dy));
  if (steps < 1) return true;
  const double step_x = dx / steps, step_y = dy / steps, step_z = (eye.z - z) / steps;
  if (step_z <= 0) return false;  // the camera is below the cell
  const int last = static_cast<int>(std::clamp(std::ceil((highest_ - tolerance_m_ - z) / step_z), 0.0, steps));
  const bool along_x = std::abs(dx) >= std::abs(dy);
  const double other_step = std::abs(along_x ? step_y : step_x);
  constexpr double kLess = 1 - 1e-12;  // a step too few is looked at again, one too many could miss a cell
  const BlockExit exit{(along_x ? step_x : step_y) > 0, (along_x ? step_y : step_x) > 0,
                       other_step > 0 ? kLess / other_step : std::numeric_limits<double>::infinity()};
  for (int i = 1; i <= last;) {
    const int x = rounded(column + i * step_x), y = rounded(row + i * step_y);
    if (!height_m_.contains(x, y)) return true;
    const double limit = z + i * step_z + tolerance_m_;
    // The ray only rises: nothing in a block that ends below it can hide the cell.
    const int clear = coarse_max_(x >> kCoarse, y >> kCoarse) <= limit ? 1 << kCoarse
                      : fine_max_(x >> kFine, y >> kFine) <= limit     ? 1 << kFine
                                                                       : 0;
    if (clear > 0) {
      i += along_x ? exit.steps(clear, x, y) : exit.steps(clear, y, x);
      continue;
    }
    if (height_m_(x, y) > limit) return false;  // never of NaN
    ++i;
  }
  return true;
}

}  // namespace skysweep::sweep
