// SPDX-License-Identifier: Apache-2.0
#include "sweep/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {

constexpr int kBlock = 16;
constexpr float kNothing = -std::numeric_limits<float>::infinity();

float known_or_nothing(float height) { return std::isnan(height) ? kNothing : height; }

}  // namespace

SurfaceVisibility::SurfaceVisibility(const Grid& grid, const Array2d<float>& height_m, double tolerance_m)
    : grid_(grid),
      height_m_(height_m),
      tolerance_m_(tolerance_m),
      block_max_((grid.width + kBlock - 1) / kBlock, (grid.height + kBlock - 1) / kBlock, kNothing),
      highest_(kNothing) {
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      float& block = block_max_(column / kBlock, row / kBlock);
      block = std::max(block, known_or_nothing(height_m(column, row)));
      highest_ = std::max(highest_, block);
    }
  }
}

bool SurfaceVisibility::sees(Vec3d eye, int column, int row, double z) const {
  // One step moves one cell along the longer of the two grid axes; the nearest cell is tested at each step.
  const Vec2d cell = grid_.cell_center(column, row);
  const double dx = (eye.x - cell.x) / grid_.cell_m, dy = (cell.y - eye.y) / grid_.cell_m;
  const double steps = std::max(std::abs(dx), std::abs(dy));
  if (steps < 1) return true;
  const double step_x = dx / steps, step_y = dy / steps, step_z = (eye.z - z) / steps;
  if (step_z <= 0) return false;  // the camera is below the cell
  const int last = static_cast<int>(std::min(steps, std::ceil((highest_ - tolerance_m_ - z) / step_z)));
  for (int i = 1; i <= last;) {
    const int x = static_cast<int>(std::lround(column + i * step_x));
    const int y = static_cast<int>(std::lround(row + i * step_y));
    if (!height_m_.contains(x, y)) return true;
    const double limit = z + i * step_z + tolerance_m_;
    if (block_max_(x / kBlock, y / kBlock) <= limit) {
      // The ray only rises: nothing in this block can hide the cell. Go to the step that leaves it along the longer
      // axis.
      const bool along_x = std::abs(dx) >= std::abs(dy);
      const int position = (along_x ? x : y) % kBlock;
      const bool forwards = (along_x ? step_x : step_y) > 0;
      // The other axis may leave the block earlier; then the block beyond is tested again from its own entry.
      const double other_step = std::abs(along_x ? step_y : step_x);
      const int other_position = (along_x ? y : x) % kBlock;
      const bool other_forwards = (along_x ? step_y : step_x) > 0;
      const int room = forwards ? kBlock - position : position + 1;
      const int other_room = other_forwards ? kBlock - 1 - other_position : other_position;
      const int other_steps = other_step > 0 ? static_cast<int>(other_room / other_step) : room;
      i += std::max(1, std::min(room, other_steps));
      continue;
    }
    if (known_or_nothing(height_m_(x, y)) > limit) return false;
    ++i;
  }
  return true;
}

}  // namespace skysweep::sweep
