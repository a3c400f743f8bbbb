// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sweep/cost_volume.h"

namespace skysweep::sweep::reference {

// The formula of sweep/smoothing.h, path by path.
CostVolume smooth(const SweepProblem& problem, const CostVolume& costs);

}  // namespace skysweep::sweep::reference
