// SPDX-License-Identifier: Apache-2.0
// Takes back heights that nothing around them supports: false matches come in small, uneven patches.
#pragma once

#include "sweep/heights.h"

namespace skysweep::sweep {

// A patch of neighbours that differ by at most kSpecklePatchPlanes plane steps, of fewer than speckle_cells cells
// (SweepOptions), becomes NaN, unless it holds a level part: neighbours that differ by at most kLevelPlanes, at least
// 1 / kLevelShare of speckle_cells of them: the top of a mast has one, chance hardly ever. And unless less than
// kSmallestSupport of the cells around it, up to kSupportRadius columns and rows from its first cell, belong to large
// patches: where all is rough, as in the crowns of trees, nothing around a patch speaks against it. The standard
// deviations of what is dropped become NaN, too.
void drop_speckles(const SweepProblem& problem, Heights& heights);

constexpr double kSpecklePatchPlanes = 8, kLevelPlanes = 2;
constexpr int kLevelShare = 4;
constexpr int kSupportRadius = 8;
constexpr double kSmallestSupport = 0.5;

}  // namespace skysweep::sweep
