// SPDX-License-Identifier: Apache-2.0
// The costs of the planes around the best one of each cell, side by side: what the refinement between planes reads
// again and again, without looking each of them up in the volume.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sweep/cost_volume.h"
#include "sweep/match_result.h"

namespace skysweep::sweep {

constexpr int kSameSurfacePlanes = 3;  // a cell whose best plane is farther from the one asked for is another surface

struct CostsNearBest {
  // Of the planes best - kSameSurfacePlanes - 1 .. best + kSameSurfacePlanes + 1; one more, unused, fills four words.
  std::array<Cost, 2 * kSameSurfacePlanes + 4> costs;
  // Bit i: plane best - kSameSurfacePlanes + i is stored with both neighbours, and these have a cost. None for a cell
  // without a best plane.
  std::uint32_t usable;
  std::int32_t best;
  std::int32_t expected;  // whole plane nearest to the one expected; kNothingExpected
  float expected_exactly;
};

constexpr std::int32_t kNothingExpected = INT32_MIN;

// Of the cells of rows [first_row, last_row), row by row.
std::vector<CostsNearBest> costs_near_best(const SweepProblem& problem, const CostVolume& costs,
                                           const MatchResult& result, int first_row, int last_row);

}  // namespace skysweep::sweep
