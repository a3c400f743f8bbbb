// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_sweep.h"

#include "sweep/filling.h"
#include "sweep/heights.h"
#include "sweep/hidden_cells.h"
#include "sweep/orthophoto.h"
#include "sweep/photometric_evidence.h"
#include "sweep/speckles.h"

namespace skysweep::sweep {

SweepResult plane_sweep(const SweepProblem& problem, Backend backend, Executor& executor) {
  problem.check();
  const MatchResult matches = match_planes(problem, backend, executor);
  Heights heights = heights_from_matches(problem, matches);
  drop_heights_without_evidence(problem, matches, executor, heights);
  drop_speckles(problem, heights);
  drop_hidden_heights(problem, executor, heights);
  SweepResult result;
  result.filled = fill_hidden_cells(problem, executor, heights);
  result.height_m = std::move(heights.height_m);
  result.sigma_m = std::move(heights.sigma_m);
  colorize(problem, executor, result);
  return result;
}

}  // namespace skysweep::sweep
