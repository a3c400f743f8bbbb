// SPDX-License-Identifier: Apache-2.0
#include "sweep/best_planes.h"

#include <algorithm>
#include <cstdlib>

#include "sweep/smoothing.h"

namespace skysweep::sweep {
namespace {

void find_least(const CellValues& cell, PlaneWinner& winner) {
  winner.sum = kBeyondRange;
  for_each_stored_range(*cell.planes, [&](StoredRange range) {
    const Cost* first = cell.sums + range.slot;
    const Cost* least = std::min_element(first, first + range.planes.count());
    if (*least >= winner.sum) return;
    const auto at = static_cast<int>(least - first);
    winner.plane = range.planes.first + at;
    winner.slot = range.slot + at;
    winner.sum = *least;
    winner.has_neighbours = at > 0 && at < range.planes.count() - 1;
  });
}

void find_rival(const CellValues& cell, PlaneWinner& winner) {
  for_each_stored_range(*cell.planes, [&](StoredRange range) {
    const Cost* sum = cell.sums + range.slot;
    const int count = range.planes.count();
    for (int i = 0; i < count; ++i) {
      if (sum[i] >= winner.rival_sum || std::abs(range.planes.first + i - winner.plane) <= kRivalDistance) continue;
      const bool falls = i > 0 && sum[i - 1] < sum[i], rises = i + 1 < count && sum[i + 1] < sum[i];
      if (falls || rises) continue;
      winner.rival_plane = range.planes.first + i;
      winner.rival_sum = sum[i];
    }
  });
}

void add_up_costs(const CellValues& cell, PlaneWinner& winner) {
  for_each_stored_range(*cell.planes, [&](StoredRange range) {
    const Cost* cost = cell.costs + range.slot;
    for (int i = 0; i < range.planes.count(); ++i) {
      winner.seen += cost[i] != kWorstCost;
      winner.total_cost += cost[i] != kWorstCost ? cost[i] : 0;
    }
  });
}

}  // namespace

void store(const PlaneWinner& winner, const CellValues& cell, int column, int row, MatchResult& result) {
  const Cost cost = cell.costs[winner.slot];
  if (winner.seen == 0 || cost == kWorstCost) return;
  result.plane(column, row) = winner.plane;
  result.cost(column, row) = static_cast<float>(cost / kCostScale);
  result.mean_cost(column, row) = static_cast<float>(winner.total_cost / winner.seen / kCostScale);
  constexpr double kSumScale = kCostScale * kSmoothingPaths;
  if (winner.rival_sum != kBeyondRange) {
    result.rival_plane(column, row) = winner.rival_plane;
    result.rival_excess(column, row) = static_cast<float>((winner.rival_sum - winner.sum) / kSumScale);
  }
  if (!winner.has_neighbours) return;
  const Cost* sum = cell.sums + winner.slot;
  const Parabola parabola = parabola_through(sum[-1] / kSumScale, sum[0] / kSumScale, sum[1] / kSumScale);
  result.fraction(column, row) = static_cast<float>(parabola.vertex);
  result.bend(column, row) = static_cast<float>(parabola.bend);
}

MatchResult best_planes(const CostVolume& costs, const CostVolume& sums) {
  MatchResult result(costs.width(), costs.height());
  for (int row = 0; row < costs.height(); ++row) {
    for (int column = 0; column < costs.width(); ++column) {
      const PlaneSet& planes = costs.planes_at(column, row);
      if (planes.empty()) continue;
      const CellValues cell{&planes, costs.cell(column, row), sums.cell(column, row)};
      PlaneWinner winner;
      find_least(cell, winner);
      find_rival(cell, winner);
      add_up_costs(cell, winner);
      store(winner, cell, column, row, result);
    }
  }
  return result;
}

}  // namespace skysweep::sweep
