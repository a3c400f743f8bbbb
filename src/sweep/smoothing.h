// SPDX-License-Identifier: Apache-2.0
// Semi-global smoothing over the cost volume (Hirschmueller 2008, in object space as Bethmann and Luhmann 2015): along
// eight directions r,
//   L_r(p, k) = C(p, k) + min(L_r(p - r, k), L_r(p - r, k +- 1) + P1, min_i L_r(p - r, i) + P2) - min_i L_r(p - r, i),
// and the sum over r replaces the cost. P1 is the price of a step of one plane, P2 that of any larger one. A path
// starts at the border of the grid with L = C. Whole numbers: every backend gives the same sums, bit for bit.
#pragma once

#include "sweep/backend.h"
#include "sweep/cost_volume.h"

namespace skysweep::sweep {

constexpr int kSmoothingPaths = 8;

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs, Backend backend);

}  // namespace skysweep::sweep
