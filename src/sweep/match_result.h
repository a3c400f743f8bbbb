// SPDX-License-Identifier: Apache-2.0
// What the search over planes finds in each cell, before anything is decided about it; `heights_from_matches` goes on
// from here.
#pragma once

#include "core/array2d.h"

namespace skysweep::sweep {

struct MatchResult {
  MatchResult() = default;
  MatchResult(int width, int height);

  Array2d<int> plane;   // k of the best plane z = k dz; on ties the lowest plane; meaningless where cost is infinite
  Array2d<float> cost;  // matching cost at the best plane, grey levels; infinity = too few views
  Array2d<float> mean_cost;  // over all planes that had a cost
  Array2d<float> fraction;   // where the cost curve is least, planes above the best
  Array2d<float> bend;       // second difference there, grey levels; NaN (both) where a neighbour has no cost

  // With smoothing, the lowest other minimum of the cost curve that is more than kRivalDistance planes away, and how
  // much higher it is, grey levels; infinity where there is none.
  Array2d<int> rival_plane;
  Array2d<float> rival_excess;
};

constexpr int kRivalDistance = 3;

// Vertex (relative to the middle) and second difference of the parabola through three values one apart, the middle one
// being the least; NaN for both if a value is not finite or the three lie on a line.
struct Parabola {
  double vertex = 0;
  double bend = 0;
};
Parabola parabola_through(double below, double middle, double above);

}  // namespace skysweep::sweep
