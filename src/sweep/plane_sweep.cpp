// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_sweep.h"

#include "sweep/heights.h"
#include "sweep/orthophoto.h"
#include "sweep/photometric_evidence.h"

namespace skysweep::sweep {

SweepResult plane_sweep(const SweepProblem& problem, Backend backend, Executor& executor) {
  problem.check();
  const MatchResult matches = match_planes(problem, backend, executor);
  Heights heights = heights_from_matches(problem, matches);
  drop_heights_without_evidence(problem, matches, executor, heights);
  SweepResult result;
  result.height_m = std::move(heights.height_m);
  result.sigma_m = std::move(heights.sigma_m);
  colorize(problem, executor, result);
  return result;
}

}  // namespace skysweep::sweep
