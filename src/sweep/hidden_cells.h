// SPDX-License-Identifier: Apache-2.0
// Cells that photographs show, but the surface hides from them.
#pragma once

#include "sweep/sweep_problem.h"
#include "sweep/visibility.h"

namespace skysweep::sweep {

// How far the surface must rise above a ray to hide what is behind, in plane steps: more than heights scatter.
constexpr double kOcclusionTolerancePlanes = 3;

// Whether fewer than min_views views (SweepOptions) see the cell at height z past `surface`, so that no place of that
// height can be measured there, although at least twice as many show it: where fewer do, at the border of the map,
// heights are not good enough to say that one hides another.
bool is_hidden(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row, double z);

}  // namespace skysweep::sweep
