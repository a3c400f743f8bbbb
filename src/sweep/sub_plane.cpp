// SPDX-License-Identifier: Apache-2.0
#include "sweep/sub_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace skysweep::sweep {
namespace {

constexpr int kSameSurfacePlanes = 3;

// Sums of costs at one plane and its neighbours: whole numbers, so the order of addition does not matter.
struct CostTriple {
  std::array<std::int64_t, 3> sum{};
  double rise_error = 0;  // of the cells that were added up
  int cells = 0;
};

void add(const CostVolume& costs, int column, int row, int plane, float rise_error, CostTriple& triple) {
  const Cost* cost = costs.find(column, row, plane);
  if (!cost || !costs.find(column, row, plane - 1) || !costs.find(column, row, plane + 1)) return;
  if (cost[-1] == kWorstCost || cost[1] == kWorstCost) return;
  for (int i = 0; i < 3; ++i) triple.sum[i] += cost[i - 1];
  triple.rise_error += rise_error;
  ++triple.cells;
}

CostTriple costs_around(const SweepProblem& problem, const CostVolume& costs, const MatchResult& result, int column,
                        int row, int plane) {
  CostTriple triple;
  const int radius = problem.options.refinement_radius_cells;
  const int left = std::max(0, column - radius), right = std::min(costs.width() - 1, column + radius);
  const int top = std::max(0, row - radius), bottom = std::min(costs.height() - 1, row + radius);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      if (!std::isfinite(result.cost(x, y))) continue;
      const SweepProblem::Rise rise = problem.expected_rise(column, row, x, y, radius);
      const int same = plane + rise.planes;
      if (std::abs(result.plane(x, y) - same) <= kSameSurfacePlanes) add(costs, x, y, same, rise.error, triple);
    }
  }
  return triple;
}

// Planes above the cell's best one; NaN if the cells around do not tell.
double refined_fraction(const SweepProblem& problem, const CostVolume& costs, const MatchResult& result, int column,
                        int row) {
  const int best = result.plane(column, row);
  CostTriple around = costs_around(problem, costs, result, column, row, best);
  // Where two planes are nearly equal, chance chose between them: the least of the common costs must not depend on it.
  const int step = around.sum[0] < around.sum[1] ? -1 : around.sum[2] < around.sum[1] ? 1 : 0;
  if (step != 0) around = costs_around(problem, costs, result, column, row, best + step);
  const auto [below, middle, above] = around.sum;
  const double mean_rise_error = around.cells > 0 ? around.rise_error / around.cells : 0;
  return step - mean_rise_error +
         std::clamp(
             sub_plane_vertex(static_cast<double>(below), static_cast<double>(middle), static_cast<double>(above)),
             -0.5, 0.5);
}

}  // namespace

double sub_plane_vertex(double below, double middle, double above) {
  const double bend = below - 2 * middle + above, rise = std::max(below, above) - middle;
  if (!(bend > 0 && rise > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double lean = 0.5 * (below - above);
  return 0.5 * (lean / bend + lean / rise);
}

void refine_fractions(const SweepProblem& problem, const CostVolume& costs, Executor& executor, MatchResult& result) {
  if (problem.options.refinement_radius_cells == 0) return;
  executor.parallel_for(costs.height(), [&](int row) {
    for (int column = 0; column < costs.width(); ++column) {
      if (!std::isfinite(result.fraction(column, row))) continue;
      const double fraction = refined_fraction(problem, costs, result, column, row);
      if (std::isfinite(fraction)) result.fraction(column, row) = static_cast<float>(fraction);
    }
  });
}

}  // namespace skysweep::sweep
