// SPDX-License-Identifier: Apache-2.0
// The highest cell of each square block of a grid: lets a ray that climbs over a surface jump across what lies below
// it.
#pragma once

#include <algorithm>
#include <limits>

#include "core/array2d.h"

namespace skysweep::sweep {

class BlockMaxima {
 public:
  // NaN cells are not there: a block of nothing else is lower than everything.
  explicit BlockMaxima(const Array2d<float>& values) : coarse_(maxima(values, kCoarse)), fine_(maxima(values, kFine)) {}

  float highest() const { return *std::max_element(coarse_.begin(), coarse_.end()); }

  // Side in cells of the larger block around a cell of whose highest value `is_clear` holds; 0 where it holds of none:
  // then the cells must be looked at one by one.
  template <typename IsClear>
  int clear_cells(int column, int row, IsClear is_clear) const {
    if (is_clear(coarse_(column >> kCoarse, row >> kCoarse))) return 1 << kCoarse;
    return is_clear(fine_(column >> kFine, row >> kFine)) ? 1 << kFine : 0;
  }

 private:
  static constexpr int kCoarse = 4, kFine = 2;  // blocks of 2^kCoarse x 2^kCoarse and 2^kFine x 2^kFine cells

  static Array2d<float> maxima(const Array2d<float>& values, int shift) {
    const auto blocks = [shift](int cells) { return ((cells - 1) >> shift) + 1; };
    Array2d<float> out(blocks(values.width()), blocks(values.height()), -std::numeric_limits<float>::infinity());
    for (int row = 0; row < values.height(); ++row) {
      const float* from = values.row(row);
      float* to = out.row(row >> shift);
      for (int column = 0; column < values.width(); ++column)
        if (from[column] > to[column >> shift]) to[column >> shift] = from[column];  // never of NaN
    }
    return out;
  }

  Array2d<float> coarse_, fine_;
};

// As std::lround, without a call; for numbers that an int can hold.
inline int rounded(double value) {
  const int whole = static_cast<int>(value);
  const double rest = value - whole;
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

// Leaves blocks of cells along a ray that moves one cell along the longer of the two grid axes each step.
class BlockExit {
 public:
  // Columns and rows that one step moves.
  BlockExit(double step_x, double step_y) : along_x_(std::max(step_x, -step_x) >= std::max(step_y, -step_y)) {
    const double step = along_x_ ? step_x : step_y, other = along_x_ ? step_y : step_x;
    constexpr double kLess = 1 - 1e-12;  // a step too few is looked at again, one too many could miss a cell
    forwards_ = step > 0;
    other_forwards_ = other > 0;
    steps_per_cell_ = other != 0 ? kLess / std::max(other, -other) : std::numeric_limits<double>::infinity();
  }

  // Steps that the ray may take at once and still lie in its block of `size` cells, a power of two, or, after the last
  // of them, in the first cell beyond. With infinitely many steps a cell a ray never leaves sideways (no room times
  // infinity is NaN, and std::min then keeps the other).
  int steps(int size, int column, int row) const {
    const int position = (along_x_ ? column : row) & (size - 1), other = (along_x_ ? row : column) & (size - 1);
    const int room = forwards_ ? size - position : position + 1;
    const int other_room = other_forwards_ ? size - 1 - other : other;
    return std::max(1, static_cast<int>(std::min<double>(room, other_room * steps_per_cell_)));
  }

 private:
  bool along_x_, forwards_, other_forwards_;
  double steps_per_cell_;  // along the shorter axis
};

}  // namespace skysweep::sweep
