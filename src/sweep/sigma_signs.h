// SPDX-License-Identifier: Apache-2.0
// What tells how far a height may be off: the rays, the cost curves and the neighbourhood.
#pragma once

#include "core/array2d.h"
#include "sweep/edge_evidence.h"
#include "sweep/heights.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Cell by cell. Windows are squares of so many columns and rows.
struct SigmaSigns {
  Array2d<float> height_per_pixel_m;  // ray_geometry.h
  Array2d<float> step_5_m;            // highest minus lowest height, 5 x 5 cells
  Array2d<float> step_17_m;           // 17 x 17 cells
  Array2d<float> offset_m;            // how far the height lies from the mean of 9 x 9
  Array2d<float> excess_3;            // mean by which the rival costs more, 3 x 3, grey levels: see below
  Array2d<float> excess_9;            // 9 x 9
  Array2d<float> undecided;           // share of 17 x 17 with an excess below kUndecidedExcess
  Array2d<float> bend_9;              // mean bend of the cost curves at their best planes, 9 x 9, grey levels
  Array2d<float> cost_9;              // mean cost of the best planes, 9 x 9, grey levels
  Array2d<float> cost_17;             // 17 x 17
  EdgeEvidence edges;
};

// An excess counts as at most this, and as 0 in cells without a height; without smoothing nobody looks for rivals, and
// it is 0 everywhere.
constexpr float kLargestExcess = 24, kUndecidedExcess = 4;

SigmaSigns sigma_signs(const SweepProblem& problem, const MatchResult& matches, const Array2d<float>& height_m,
                       EdgeEvidence edges = {});

}  // namespace skysweep::sweep
