// SPDX-License-Identifier: Apache-2.0
// What the views that see a place past a known surface show there, at just this place: no window around it.
#pragma once

#include <array>
#include <limits>

#include "sweep/sweep_problem.h"
#include "sweep/visibility.h"

namespace skysweep::sweep {

using MeanColor = std::array<float, 3>;  // red, green, blue, 0 to 255

// Mean over the channels of the absolute difference.
double color_difference(const MeanColor& a, const MeanColor& b);

struct PointColors {
  int seen_by = 0;      // views that see the place
  int hidden_from = 0;  // views whose photograph covers it and that the surface hides it from
  MeanColor median{};   // of those that see it, channel by channel; meaningless when none does
  double spread = 0;    // mean difference to the median, each view's no larger than `largest_difference`
};

// From where a cell is seen, worked out once for each view that is asked about.
class CellSight {
 public:
  // Nobody asks for heights below `lowest_m`. The surface and the problem must outlive this object.
  CellSight(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row, double lowest_m)
      : problem_(problem), surface_(surface), column_(column), row_(row), lowest_m_(lowest_m) {
    lowest_visible_.fill(std::numeric_limits<double>::quiet_NaN());
  }

  int column() const { return column_; }
  int row() const { return row_; }
  bool sees(int view, double z);

 private:
  const SweepProblem& problem_;
  const SurfaceVisibility& surface_;
  int column_, row_;
  double lowest_m_;
  std::array<double, kMaxViews> lowest_visible_;
};

// Of the place `offset_m` (east, north) from the middle of a cell, at height `z`, in the grid's frame; whether a view
// sees it is asked of the middle. The surface's own height in this cell hides nothing.
PointColors point_colors(const SweepProblem& problem, CellSight& sight, double z, double largest_difference,
                         Vec2d offset_m = {0, 0});

}  // namespace skysweep::sweep
