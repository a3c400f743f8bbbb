// SPDX-License-Identifier: Apache-2.0
// What the views that see a place past a known surface show there, at just this place: no window around it.
#pragma once

#include <array>

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

// Of the place `offset_m` (east, north) from the middle of a cell, at height `z`, in the grid's frame; whether a view
// sees it is asked of the middle. The surface's own height in this cell hides nothing.
PointColors point_colors(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row, double z,
                         double largest_difference, Vec2d offset_m = {0, 0});

}  // namespace skysweep::sweep
