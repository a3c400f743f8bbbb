// SPDX-License-Identifier: Apache-2.0
#include "sweep/best_planes.h"

#include <algorithm>

#include "sweep/smoothing.h"

namespace skysweep::sweep {
namespace {

void pick(const CostVolume& costs, const CostVolume& sums, int column, int row, MatchResult& result) {
  const int count = costs.planes_at(column, row).count();
  const Cost* cost = costs.cell(column, row);
  const Cost* sum = sums.cell(column, row);
  int seen = 0;
  double total = 0;
  for (int i = 0; i < count; ++i) {
    seen += cost[i] != kWorstCost;
    total += cost[i] != kWorstCost ? cost[i] : 0;
  }
  const int best = static_cast<int>(std::min_element(sum, sum + count) - sum);
  if (seen == 0 || cost[best] == kWorstCost) return;
  result.plane(column, row) = costs.planes_at(column, row).first + best;
  result.cost(column, row) = static_cast<float>(cost[best] / kCostScale);
  result.mean_cost(column, row) = static_cast<float>(total / seen / kCostScale);
  if (best == 0 || best == count - 1) return;
  constexpr double kSumScale = kCostScale * kSmoothingPaths;
  const Parabola parabola =
      parabola_through(sum[best - 1] / kSumScale, sum[best] / kSumScale, sum[best + 1] / kSumScale);
  result.fraction(column, row) = static_cast<float>(parabola.vertex);
  result.bend(column, row) = static_cast<float>(parabola.bend);
}

}  // namespace

MatchResult best_planes(const CostVolume& costs, const CostVolume& sums) {
  MatchResult result(costs.width(), costs.height());
  for (int row = 0; row < costs.height(); ++row)
    for (int column = 0; column < costs.width(); ++column)
      if (!costs.planes_at(column, row).empty()) pick(costs, sums, column, row, result);
  return result;
}

}  // namespace skysweep::sweep
