// SPDX-License-Identifier: Apache-2.0
// From matches to heights: sub-plane refinement, the decision what is known at all.
#pragma once

#include "core/array2d.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

struct Heights {
  Array2d<float> height_m;  // NaN where nothing is known
  Array2d<float> sigma_m;   // NaN until set_sigma (height_sigma.h)
};

// A cell has a height when enough views show it, the best plane lies between two others with costs, its cost is below
// the thresholds, and the cost curve bends upwards there. The height is the vertex of the parabola through the three
// costs.
Heights heights_from_matches(const SweepProblem& problem, const MatchResult& matches);

}  // namespace skysweep::sweep
