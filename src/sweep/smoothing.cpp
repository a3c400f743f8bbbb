// SPDX-License-Identifier: Apache-2.0
#include "sweep/smoothing.h"

#include "sweep/cpu/smoothing_cpu.h"
#include "sweep/reference/smoothing_reference.h"

namespace skysweep::sweep {

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs, Backend backend) {
  return backend == Backend::reference ? reference::smooth(problem, costs) : cpu::smooth(problem, costs);
}

}  // namespace skysweep::sweep
