// SPDX-License-Identifier: Apache-2.0
// The winner of each cell from its costs and their smoothed sums.
#pragma once

#include "sweep/cost_volume.h"
#include "sweep/match_result.h"

namespace skysweep::sweep {

// The plane with the least sum wins, the lowest one on ties; the parabola goes through the sums (per path), cost and
// mean cost are those of the cell itself.
MatchResult best_planes(const CostVolume& costs, const CostVolume& sums);

// Its steps, for backends that find the winner of a cell in their own way. What a cell has of both volumes:
struct CellValues {
  const PlaneSet* planes = nullptr;
  const Cost* costs = nullptr;
  const Cost* sums = nullptr;
};

struct PlaneWinner {
  int plane = 0;  // the least sum, of the lowest of equals
  int slot = 0;   // where its values lie among the cell's
  Cost sum = 0;
  bool has_neighbours = false;  // in the same range
  // The lowest minimum of the sums more than kRivalDistance planes from it, of the lowest of equals; the ends of a
  // range count as minima. kBeyondRange: there is none.
  int rival_plane = 0;
  Cost rival_sum = kBeyondRange;
  int seen = 0;           // planes that have a cost
  double total_cost = 0;  // of these: a whole number
};

void store(const PlaneWinner& winner, const CellValues& cell, int column, int row, MatchResult& result);

}  // namespace skysweep::sweep
