// SPDX-License-Identifier: Apache-2.0
#include "sweep/backend.h"

#include "sweep/best_planes.h"
#include "sweep/cpu/match_cpu.h"
#include "sweep/reference/match_reference.h"
#include "sweep/smoothing.h"

namespace skysweep::sweep {

const char* to_string(Backend backend) {
  switch (backend) {
    case Backend::reference: return "reference";
    case Backend::cpu: return "cpu";
  }
  return "unknown";
}

MatchResult match_planes(const SweepProblem& problem, Backend backend, Executor& executor) {
  if (problem.options.smoothing == Smoothing::none) return match_cell_by_cell(problem, backend, executor);
  const CostVolume costs = match_costs(problem, backend, executor);
  return best_planes(costs, smooth(problem, costs, backend));
}

CostVolume match_costs(const SweepProblem& problem, Backend backend, Executor& executor) {
  return backend == Backend::reference ? reference::match_costs(problem, executor)
                                       : cpu::match_costs(problem, executor);
}

MatchResult match_cell_by_cell(const SweepProblem& problem, Backend backend, Executor& executor) {
  return backend == Backend::reference ? reference::match_cell_by_cell(problem, executor)
                                       : cpu::match_cell_by_cell(problem, executor);
}

}  // namespace skysweep::sweep
