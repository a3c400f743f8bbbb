// SPDX-License-Identifier: Apache-2.0
// True-orthophoto colours of a surface: each cell takes its colour from views that the surface itself does not hide.
#pragma once

#include "core/executor.h"
#include "sweep/sweep_problem.h"
#include "sweep/sweep_result.h"

namespace skysweep::sweep {

// Fills color, color_view, planar and view_count of `result` from its heights: from the view that suits the cell and
// its neighbours best (sweep/view_choice.h) or the mean of those that agree, as options.orthophoto says, with different
// exposures made equal (sweep/exposure.h) if options.compensate_exposure. Cells without height stay without colour
// unless options.planar_fallback: then they are coloured as if they lay on the lowest plane searched, from the view
// that shows them nearest its image centre, as photographed, and marked planar. The collar stays without.
void colorize(const SweepProblem& problem, Executor& executor, SweepResult& result);

}  // namespace skysweep::sweep
