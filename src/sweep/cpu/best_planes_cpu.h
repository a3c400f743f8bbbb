// SPDX-License-Identifier: Apache-2.0
// sweep/best_planes.h with SIMD across planes: the same, bit for bit.
#pragma once

#include "core/executor.h"
#include "sweep/cost_volume.h"
#include "sweep/match_result.h"

namespace skysweep::sweep::cpu {

MatchResult best_planes(const CostVolume& costs, const CostVolume& sums, Executor& executor);

}  // namespace skysweep::sweep::cpu
