// SPDX-License-Identifier: Apache-2.0
// The winner of each cell from its costs and their smoothed sums.
#pragma once

#include "sweep/cost_volume.h"
#include "sweep/match_result.h"

namespace skysweep::sweep {

// The plane with the least sum wins, the lowest one on ties; the parabola goes through the sums (per path), cost and
// mean cost are those of the cell itself.
MatchResult best_planes(const CostVolume& costs, const CostVolume& sums);

}  // namespace skysweep::sweep
