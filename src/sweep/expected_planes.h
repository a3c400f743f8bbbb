// SPDX-License-Identifier: Apache-2.0
// A smooth surface expected from a coarser search, so that smoothing follows slopes instead of treading them into
// steps (after Scharstein, Taniai and Sinha 2017, with the coarse surface in place of fitted planes).
#pragma once

#include "core/array2d.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// For each cell of `problem`, in its planes, the slope through the sure heights around it in `found`, which was
// searched on cells and planes `times` as large, 1 or 2; NaN where the cell's own height is not sure.
Array2d<float> expected_planes(const MatchResult& found, int times, const SweepProblem& problem);

}  // namespace skysweep::sweep
