// SPDX-License-Identifier: Apache-2.0
// The plane search as one would write it on paper: scalar, double precision, no shortcut. The oracle of the backends.
#pragma once

#include "core/executor.h"
#include "sweep/cost_volume.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep::reference {

CostVolume match_costs(const SweepProblem& problem, Executor& executor);
MatchResult match_cell_by_cell(const SweepProblem& problem, Executor& executor);

}  // namespace skysweep::sweep::reference
