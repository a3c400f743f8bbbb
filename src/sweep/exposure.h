// SPDX-License-Identifier: Apache-2.0
// By how much the views of a tile were exposed differently, found from the colours they show at the same places, and
// how those are made to agree. Only what differs is touched: views of equal exposure keep every byte.
//
// Each channel of a view has a gain on linear light, so that white balance is covered, too. Only ratios of gains can be
// known. What they are brought to is the weighted geometric mean of the gains of the views that show the place, the
// weight of a view falling to nothing towards its photograph's border: it depends on nothing else, so that neighbouring
// tiles, which share the views at their border, agree there, and changes smoothly from place to place.
#pragma once

#include <array>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "sweep/color_candidates.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Logarithms of gains on linear light: red, green, blue.
using LogGain = std::array<double, 3>;

// Views differ when the gains of two of them do by more than this, and surely so; 2 % is a grey level in the middle of
// the range.
constexpr double kEqualExposure = 0.02;

// The views' gains up to a common factor (their mean logarithm is 0): the least squares of the medians over the places
// that two views show, for all pairs of views, weighted by their scatter. Empty when the exposures do not differ.
// Every `step`th cell both ways is compared.
std::vector<LogGain> estimate_exposures(const Array2d<CellCandidates>& cells, int views, int step = 4);

// Replaces the candidates' colours by what a photograph of the mean exposure at that place would show.
// `log_gains` of all views; `height_m` of the whole grid.
void equalize_exposures(const SweepProblem& problem, const Array2d<float>& height_m, const CoreWithMargin& region,
                        const std::vector<LogGain>& log_gains, Executor& executor, Array2d<CellCandidates>& cells);

}  // namespace skysweep::sweep
