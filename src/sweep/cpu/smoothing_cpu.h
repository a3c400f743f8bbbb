// SPDX-License-Identifier: Apache-2.0
// Semi-global smoothing with SIMD across planes, in two passes over the grid: from the north with the four directions
// that come from above or from the west, then from the south with the four others.
#pragma once

#include "sweep/cost_volume.h"

namespace skysweep::sweep::cpu {

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs);

}  // namespace skysweep::sweep::cpu
