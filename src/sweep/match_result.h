// SPDX-License-Identifier: Apache-2.0
// What the search over planes finds in each cell, before anything is decided about it. The stage that every backend
// implements; `heights_from_matches` goes on from here.
#pragma once

#include <cstdint>

#include "core/array2d.h"

namespace skysweep::sweep {

struct MatchResult {
  MatchResult() = default;
  MatchResult(int width, int height);

  // Costs are mean absolute differences in grey levels; infinity = too few views.
  Array2d<int> plane;                // k of the best plane z = k dz; meaningless where cost is infinite
  Array2d<float> cost;               // at the best plane; on ties the lowest plane wins
  Array2d<float> cost_below;         // at the plane below it; infinity if not searched or not seen
  Array2d<float> cost_above;         // at the plane above it
  Array2d<float> mean_cost;          // over all planes that had a cost
  Array2d<std::uint8_t> view_count;  // views that show the cell at the best plane
};

}  // namespace skysweep::sweep
