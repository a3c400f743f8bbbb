// SPDX-License-Identifier: Apache-2.0
// How the surface found so far looks from above: steps in height are cheaper where this picture has an edge
// (Hirschmueller 2008).
#pragma once

#include <cstdint>

#include "core/array2d.h"
#include "core/executor.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Luminance of each cell of `problem`, grey levels 1 to 255, at the height that `found` gives it: the median over the
// views nearest to its nadir. `found` was searched on cells and planes `times` as large. 0 where nothing was found.
Array2d<std::uint8_t> guide_image(const SweepProblem& problem, const MatchResult& found, int times, Executor& executor);

}  // namespace skysweep::sweep
