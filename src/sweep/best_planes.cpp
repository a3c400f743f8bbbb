// SPDX-License-Identifier: Apache-2.0
#include "sweep/best_planes.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "sweep/smoothing.h"

namespace skysweep::sweep {
namespace {

// The plane with the least sum, the lowest of equals.
struct Best {
  int plane = 0;
  const Cost* cost = nullptr;
  const Cost* sum = nullptr;
  bool has_neighbours = false;
};

Best least_sum(const CostVolume& costs, const CostVolume& sums, int column, int row) {
  Best best;
  for_each_stored_range(costs.planes_at(column, row), [&](StoredRange range) {
    const Cost* first = sums.cell(column, row) + range.slot;
    const Cost* least = std::min_element(first, first + range.planes.count());
    if (best.sum && *least >= *best.sum) return;
    const auto at = static_cast<int>(least - first);
    best = {range.planes.first + at, costs.cell(column, row) + range.slot + at, least,
            at > 0 && at < range.planes.count() - 1};
  });
  return best;
}

// The lowest minimum of the sums more than kRivalDistance planes from the best, the lowest of equals; the ends of a
// range count as minima.
struct Rival {
  int plane = 0;
  Cost sum = kBeyondRange;
};

Rival rival_of(const Best& best, const CostVolume& sums, int column, int row) {
  Rival rival;
  for_each_stored_range(sums.planes_at(column, row), [&](StoredRange range) {
    const Cost* sum = sums.cell(column, row) + range.slot;
    const int count = range.planes.count();
    for (int i = 0; i < count; ++i) {
      if (sum[i] >= rival.sum || std::abs(range.planes.first + i - best.plane) <= kRivalDistance) continue;
      const bool falls = i > 0 && sum[i - 1] < sum[i], rises = i + 1 < count && sum[i + 1] < sum[i];
      if (!falls && !rises) rival = {range.planes.first + i, sum[i]};
    }
  });
  return rival;
}

// Mean over the planes that have a cost; nothing if none has.
std::optional<double> mean_cost(const CostVolume& costs, int column, int row) {
  int seen = 0;
  double total = 0;
  for_each_stored_range(costs.planes_at(column, row), [&](StoredRange range) {
    const Cost* cost = costs.cell(column, row) + range.slot;
    for (int i = 0; i < range.planes.count(); ++i) {
      seen += cost[i] != kWorstCost;
      total += cost[i] != kWorstCost ? cost[i] : 0;
    }
  });
  if (seen == 0) return std::nullopt;
  return total / seen;
}

void pick(const CostVolume& costs, const CostVolume& sums, int column, int row, MatchResult& result) {
  const std::optional<double> mean = mean_cost(costs, column, row);
  const Best best = least_sum(costs, sums, column, row);
  if (!mean || *best.cost == kWorstCost) return;
  result.plane(column, row) = best.plane;
  result.cost(column, row) = static_cast<float>(*best.cost / kCostScale);
  result.mean_cost(column, row) = static_cast<float>(*mean / kCostScale);
  constexpr double kSumScale = kCostScale * kSmoothingPaths;
  if (const Rival rival = rival_of(best, sums, column, row); rival.sum != kBeyondRange) {
    result.rival_plane(column, row) = rival.plane;
    result.rival_excess(column, row) = static_cast<float>((rival.sum - *best.sum) / kSumScale);
  }
  if (!best.has_neighbours) return;
  const Parabola parabola =
      parabola_through(best.sum[-1] / kSumScale, best.sum[0] / kSumScale, best.sum[1] / kSumScale);
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
