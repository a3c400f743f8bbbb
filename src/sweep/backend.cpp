// SPDX-License-Identifier: Apache-2.0
#include "sweep/backend.h"

#include "sweep/bands.h"
#include "sweep/best_planes.h"
#include "sweep/cpu/match_cpu.h"
#include "sweep/reference/match_reference.h"
#include "sweep/smoothing.h"
#include "sweep/sub_plane.h"

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
  MatchResult result(problem.grid.width, problem.grid.height);
  for (const Band& band : bands_within(problem)) {
    const SweepProblem part = part_of(problem, band);
    const CostVolume costs = match_costs(part, backend, executor);
    MatchResult matches = best_planes(costs, smooth(part, costs, backend));
    refine_fractions(part, costs, executor, matches);
    copy_core(matches, band, result);
  }
  return result;
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
