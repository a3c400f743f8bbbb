// SPDX-License-Identifier: Apache-2.0
// Takes back heights that nothing around them supports: false matches come in small, uneven patches.
#pragma once

#include "sweep/heights.h"

namespace skysweep::sweep {

// A patch of neighbours that differ by at most kSpecklePatchPlanes plane steps, of fewer than speckle_cells cells
// (SweepOptions), becomes NaN, unless it holds a level part: neighbours that differ by at most kLevelPlanes, at least
// 1 / kLevelShare of speckle_cells of them. The top of a mast has one, chance hardly ever. Their standard deviations
// become NaN, too.
void drop_speckles(const SweepProblem& problem, Heights& heights);

constexpr double kSpecklePatchPlanes = 8, kLevelPlanes = 2;
constexpr int kLevelShare = 4;

}  // namespace skysweep::sweep
