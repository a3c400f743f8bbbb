// SPDX-License-Identifier: Apache-2.0
// The plane search with SIMD. What makes it fast: the projection of a row of cells onto a photograph is smooth, so it
// is computed exactly (double precision, with lens distortion) only at knots kSegmentCells apart and followed in
// between by a polynomial through six knots, in single precision relative to the segment's first pixel.
#pragma once

#include "core/executor.h"
#include "sweep/cost_volume.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep::cpu {

CostVolume match_costs(const SweepProblem& problem, Executor& executor);
MatchResult match_cell_by_cell(const SweepProblem& problem, Executor& executor);

}  // namespace skysweep::sweep::cpu
