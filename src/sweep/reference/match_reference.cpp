// SPDX-License-Identifier: Apache-2.0
#include "sweep/reference/match_reference.h"

#include <limits>

#include "sweep/view_costs.h"

namespace skysweep::sweep::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Matching cost of a cell at plane k; infinity outside the planes searched there.
double cost_at(const SweepProblem& problem, Vec2d cell, PlaneRange planes, int k, int* views) {
  if (k < planes.first || k > planes.last) return kInfinity;
  const ViewCosts costs = view_costs(problem, {cell.x, cell.y, k * problem.dz_m}, nullptr);
  if (views) *views = costs.count;
  return aggregate(costs, problem.options);
}

void match_cell(const SweepProblem& problem, int column, int row, MatchResult& result) {
  const Vec2d cell = problem.grid.cell_center(column, row);
  const PlaneRange planes = problem.planes_at(column, row);
  double best = kInfinity, sum = 0;
  int best_plane = 0, seen = 0;
  for (int k = planes.first; k <= planes.last; ++k) {
    const double cost = cost_at(problem, cell, planes, k, nullptr);
    if (cost == kInfinity) continue;
    sum += cost;
    ++seen;
    if (cost < best) {  // strictly: the first plane wins a tie
      best = cost;
      best_plane = k;
    }
  }
  if (seen == 0) return;
  int views = 0;
  result.plane(column, row) = best_plane;
  result.cost(column, row) = static_cast<float>(cost_at(problem, cell, planes, best_plane, &views));
  result.cost_below(column, row) = static_cast<float>(cost_at(problem, cell, planes, best_plane - 1, nullptr));
  result.cost_above(column, row) = static_cast<float>(cost_at(problem, cell, planes, best_plane + 1, nullptr));
  result.mean_cost(column, row) = static_cast<float>(sum / seen);
  result.view_count(column, row) = static_cast<std::uint8_t>(views);
}

}  // namespace

MatchResult match_planes(const SweepProblem& problem, Executor& executor) {
  MatchResult result(problem.grid.width, problem.grid.height);
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int column = 0; column < problem.grid.width; ++column) match_cell(problem, column, row, result);
  });
  return result;
}

}  // namespace skysweep::sweep::reference
