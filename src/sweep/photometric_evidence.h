// SPDX-License-Identifier: Apache-2.0
// Takes back heights for which only the number of views speaks.
#pragma once

#include "core/executor.h"
#include "sweep/heights.h"

namespace skysweep::sweep {

// Every cost holds few_views_penalty / n (SweepOptions). Where n changes with the height, that share alone makes a
// minimum at the height that most views show, on bare surfaces, too. Heights whose cost without it does not stay below
// max_cost_to_mean times the mean without it become NaN, and their standard deviations. `mean_error`: how far a mean
// cost that was not taken over problem's own planes and cells may be off, grey levels.
void drop_heights_without_evidence(const SweepProblem& problem, const MatchResult& matches, Executor& executor,
                                   Heights& heights, double mean_error = 0);

}  // namespace skysweep::sweep
