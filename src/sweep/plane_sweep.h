// SPDX-License-Identifier: Apache-2.0
// The plane sweep: heights, their standard deviation and true-orthophoto colours of a grid of cells from photographs
// with known poses (Feldmann 2013). Pure: the same problem gives the same bits for any executor.
#pragma once

#include "sweep/backend.h"
#include "sweep/heights.h"
#include "sweep/sigma_signs.h"
#include "sweep/sweep_problem.h"
#include "sweep/sweep_result.h"

namespace skysweep::sweep {

struct Search {
  MatchResult matches;           // mean_cost: the larger of the two
  SweepProblem problem;          // with the planes that were searched in the end
  Array2d<float> all_mean;       // mean cost over all planes asked; empty when these are all the planes
  Array2d<float> searched_mean;  // over the planes searched in the end; empty likewise
  double samples = 0;            // luminance samples taken
};

// The search alone, from coarse to fine if options.coarse_levels says so, else everywhere at once.
Search search(const SweepProblem& problem, Backend backend, Executor& executor);

// A surface, and what it was made from.
struct SweptSurface {
  Array2d<float> matched_height_m;  // where something distinguishes them; before speckles are taken back
  SigmaSigns signs;                 // of the heights before gaps are filled
  Heights heights;
  Array2d<std::uint8_t> filled;  // see SweepResult
};

SweptSurface surface_of(const SweepProblem& problem, const Search& found, Executor& executor);

SweepResult plane_sweep(const SweepProblem& problem, Backend backend, Executor& executor);

}  // namespace skysweep::sweep
