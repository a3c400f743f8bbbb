// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_sweep.h"

#include <algorithm>

#include "sweep/coarse_to_fine.h"
#include "sweep/filling.h"
#include "sweep/heights.h"
#include "sweep/orthophoto.h"
#include "sweep/photometric_evidence.h"
#include "sweep/speckles.h"

namespace skysweep::sweep {

MatchResult search(const SweepProblem& problem, Backend backend, Executor& executor, double& samples) {
  if (problem.options.coarse_levels == 0) {
    samples += sample_count(problem);
    return match_planes(problem, backend, executor);
  }
  NarrowedSearch narrowed = narrow_search(problem, backend, executor, samples);
  samples += sample_count(narrowed.problem);
  MatchResult matches = match_planes(narrowed.problem, backend, executor);
  // On weak texture the coarse grid's mean has less noise than any cost here, right or wrong.
  for (std::size_t i = 0; i < matches.mean_cost.size(); ++i)
    matches.mean_cost.data()[i] = std::max(matches.mean_cost.data()[i], narrowed.mean_cost.data()[i]);
  return matches;
}

SweepResult plane_sweep(const SweepProblem& problem, Backend backend, Executor& executor) {
  problem.check();
  SweepResult result;
  const MatchResult matches = search(problem, backend, executor, result.samples);
  Heights heights = heights_from_matches(problem, matches);
  drop_heights_without_evidence(problem, matches, executor, heights);
  drop_speckles(problem, heights);
  result.filled = fill_hidden_cells(problem, executor, heights);
  result.height_m = std::move(heights.height_m);
  result.sigma_m = std::move(heights.sigma_m);
  colorize(problem, executor, result);
  return result;
}

}  // namespace skysweep::sweep
