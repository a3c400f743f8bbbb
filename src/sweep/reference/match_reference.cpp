// SPDX-License-Identifier: Apache-2.0
#include "sweep/reference/match_reference.h"

#include <limits>

#include "sweep/view_costs.h"

namespace skysweep::sweep::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Matching cost of a cell at plane k; infinity outside the planes searched there.
double cost_at(const SweepProblem& problem, int column, int row, int k) {
  if (!problem.planes_at(column, row).contains(k)) return kInfinity;
  const Vec2d cell = problem.grid.cell_center(column, row);
  const Vec3d point{cell.x, cell.y, k * problem.dz_m};
  if (!problem.visibility.any()) return matching_cost(sample_views(problem, point, nullptr), problem.options);
  std::array<bool, kMaxViews> sees{};
  for (std::size_t v = 0; v < problem.views.size(); ++v)
    sees[v] = static_cast<float>(point.z) >= problem.visibility.lowest_visible(static_cast<int>(v), column, row);
  const double cost = matching_cost(sample_views(problem, point, &sees), problem.options);
  const bool shown = sample_views(problem, point, nullptr).count >= problem.options.min_views;
  return cost == kInfinity && shown ? problem.options.hidden_cost : cost;
}

void match_cell(const SweepProblem& problem, int column, int row, MatchResult& result) {
  const PlaneRange planes = problem.planes_at(column, row).hull();
  double best = kInfinity, sum = 0;
  int best_plane = 0, seen = 0;
  for (int k = planes.first; k <= planes.last; ++k) {
    const double cost = cost_at(problem, column, row, k);
    if (cost == kInfinity) continue;
    sum += cost;
    ++seen;
    if (cost < best) {  // strictly: the first plane wins a tie
      best = cost;
      best_plane = k;
    }
  }
  if (seen == 0) return;
  const Parabola parabola = parabola_through(cost_at(problem, column, row, best_plane - 1), best,
                                             cost_at(problem, column, row, best_plane + 1));
  result.plane(column, row) = best_plane;
  result.cost(column, row) = static_cast<float>(best);
  result.mean_cost(column, row) = static_cast<float>(sum / seen);
  result.fraction(column, row) = static_cast<float>(parabola.vertex);
  result.bend(column, row) = static_cast<float>(parabola.bend);
}

}  // namespace

CostVolume match_costs(const SweepProblem& problem, Executor& executor) {
  CostVolume costs(problem, kWorstCost);
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int column = 0; column < problem.grid.width; ++column) {
      for_each_stored_range(problem.planes_at(column, row), [&](StoredRange range) {
        Cost* cost = costs.cell(column, row) + range.slot;
        for (int k = range.planes.first; k <= range.planes.last; ++k)
          *cost++ = quantized_cost(cost_at(problem, column, row, k));
      });
    }
  });
  return costs;
}

MatchResult match_cell_by_cell(const SweepProblem& problem, Executor& executor) {
  MatchResult result(problem.grid.width, problem.grid.height);
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int column = 0; column < problem.grid.width; ++column) match_cell(problem, column, row, result);
  });
  return result;
}

}  // namespace skysweep::sweep::reference
