// SPDX-License-Identifier: Apache-2.0
#include "sweep/costs_near_best.h"

#include <algorithm>
#include <cmath>

namespace skysweep::sweep {
namespace {

void copy_costs(const CostVolume& costs, int column, int row, CostsNearBest& cell) {
  constexpr int kReach = kSameSurfacePlanes + 1;
  const int lowest = cell.best - kReach, highest = cell.best + kReach;
  for_each_stored_range(costs.planes_at(column, row), [&](StoredRange range) {
    const int first = std::max(range.planes.first, lowest), last = std::min(range.planes.last, highest);
    const Cost* cost = costs.cell(column, row) + range.slot - range.planes.first;
    for (int k = first; k <= last; ++k) cell.costs[k - lowest] = cost[k];
    for (int k = first + 1; k < last; ++k)
      if (cost[k - 1] != kWorstCost && cost[k + 1] != kWorstCost) cell.usable |= 1u << (k - lowest - 1);
  });
}

}  // namespace

std::vector<CostsNearBest> costs_near_best(const SweepProblem& problem, const CostVolume& costs,
                                           const MatchResult& result, int first_row, int last_row) {
  std::vector<CostsNearBest> cells(static_cast<std::size_t>(last_row - first_row) * costs.width());
  CostsNearBest* cell = cells.data();
  for (int row = first_row; row < last_row; ++row) {
    for (int column = 0; column < costs.width(); ++column, ++cell) {
      *cell = {{}, 0, result.plane(column, row), kNothingExpected, 0};
      if (!problem.expected_plane.empty() && !std::isnan(problem.expected_plane(column, row))) {
        cell->expected_exactly = problem.expected_plane(column, row);
        cell->expected = static_cast<std::int32_t>(std::lround(cell->expected_exactly));
      }
      if (std::isfinite(result.cost(column, row))) copy_costs(costs, column, row, *cell);
    }
  }
  return cells;
}

}  // namespace skysweep::sweep
