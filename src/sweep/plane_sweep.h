// SPDX-License-Identifier: Apache-2.0
// The plane sweep: heights, their standard deviation and true-orthophoto colours of a grid of cells from photographs
// with known poses (Feldmann 2013). Pure: the same problem gives the same bits for any executor.
#pragma once

#include "sweep/backend.h"
#include "sweep/sweep_problem.h"
#include "sweep/sweep_result.h"

namespace skysweep::sweep {

// The search alone, from coarse to fine if options.coarse_levels says so, else everywhere at once. The samples it takes
// are added to `samples`.
MatchResult search(const SweepProblem& problem, Backend backend, Executor& executor, double& samples);

SweepResult plane_sweep(const SweepProblem& problem, Backend backend, Executor& executor);

}  // namespace skysweep::sweep
