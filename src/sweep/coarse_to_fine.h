// SPDX-License-Identifier: Apache-2.0
// The search from coarse to fine: grids of larger cells, photographs read at coarser mipmap levels and thicker planes
// tell which planes of the fine grid are worth looking at. A block of cells keeps the planes around everything that the
// coarser cells in and around it found, the best heights and rivals that came close, so that ground and roof both stay
// wherever between the cells the wall may stand.
#pragma once

#include "core/array2d.h"
#include "core/executor.h"
#include "sweep/backend.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

struct NarrowedSearch {
  SweepProblem problem;      // as asked, with fewer planes
  Array2d<float> mean_cost;  // of each cell, grey levels: over all planes asked, on the coarsest grid. The planes that
                             // are left all lie near a surface and do not tell what a wrong height costs
};

// At least one of options.coarse_levels; samples taken on the way are added to `samples`.
NarrowedSearch narrow_search(const SweepProblem& problem, Backend backend, Executor& executor, double& samples);

}  // namespace skysweep::sweep
