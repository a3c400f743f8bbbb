// SPDX-License-Identifier: Apache-2.0
// The patch costs of sweep/patch_costs.h on the CPU's vectors, block by block: what a view shows of a block and its
// surroundings at one plane is sampled once and shared by the patches of all its cells.
#pragma once

#include "core/executor.h"
#include "sweep/cost_volume.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep::cpu {

// As match_costs and match_cell_by_cell of sweep/cpu/match_cpu.h, for options.cost zncc and census.
CostVolume match_patch_costs(const SweepProblem& problem, Executor& executor);
MatchResult match_patches_cell_by_cell(const SweepProblem& problem, Executor& executor);

}  // namespace skysweep::sweep::cpu
