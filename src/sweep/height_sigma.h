// SPDX-License-Identifier: Apache-2.0
// The standard deviation that is claimed for a height: docs/algorithm.md, section 7.
#pragma once

#include "sweep/heights.h"
#include "sweep/match_result.h"
#include "sweep/sigma_signs.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Of all cells with a height, NaN elsewhere: in about two thirds of them the height is off by at most one, in 95 % by
// at most 1.96 of it. Fitted to scenes with exact truth (sigma_parameters.h).
Array2d<float> height_sigma(const Array2d<float>& height_m, const SigmaSigns& signs, double dz_m);

// Fills in heights.sigma_m.
void set_sigma(const SweepProblem& problem, const MatchResult& matches, Heights& heights);

}  // namespace skysweep::sweep
