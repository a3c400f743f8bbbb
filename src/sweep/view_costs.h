// SPDX-License-Identifier: Apache-2.0
// The matching cost of a point in space in double precision: how much each view differs from the others there.
// The reference search and the choice of colour are built on it.
#pragma once

#include <array>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

struct ViewCosts {
  int count = 0;                         // views that show the point
  std::array<int, kMaxViews> view{};     // their positions in problem.views, ascending
  std::array<Vec2d, kMaxViews> pixel{};  // where they show it
  std::array<double, kMaxViews> cost{};  // C_k: mean absolute luminance difference to the other views, grey levels
};

// C_k = 1 / ((n - 1) L) sum over window levels and views i of |Y_i - Y_k| (METHODS section 4, divided by the number of
// terms so that costs of different n compare). `use` says which views may take part; null means all. With fewer than
// two views the costs are zero.
ViewCosts view_costs(const SweepProblem& problem, Vec3d point, const std::array<bool, kMaxViews>* use);

// The matching cost AC of the point: C_k aggregated over views; infinity with fewer than min_views.
double aggregate(const ViewCosts& costs, const SweepOptions& options);

}  // namespace skysweep::sweep
