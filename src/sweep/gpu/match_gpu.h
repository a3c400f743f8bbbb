// SPDX-License-Identifier: Apache-2.0
// The search over planes as compute programs (OpenGL 4.5). Photographs, costs and sums stay on the device; between
// stages nothing comes back. All throw gpu::DeviceError when the device cannot do it; they may be called from any
// thread and take turns at the device.
#pragma once

#include "sweep/cost_volume.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep::on_gpu {

CostVolume match_costs(const SweepProblem& problem);
MatchResult match_cell_by_cell(const SweepProblem& problem);
CostVolume smooth(const SweepProblem& problem, const CostVolume& costs);

// With smoothing: costs, sums, best planes and fractions on the device, one dispatch each, one read-back.
MatchResult match_planes(const SweepProblem& problem);

}  // namespace skysweep::sweep::on_gpu
