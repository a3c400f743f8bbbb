// SPDX-License-Identifier: Apache-2.0
#include "sweep/reference/match_reference.h"

#include <limits>

#include "sweep/patch_costs.h"
#include "sweep/view_costs.h"

namespace skysweep::sweep::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Only the views from which height z of the cell is not hidden stay.
void keep_unhidden(const SweepProblem& problem, int column, int row, float z, ViewSamples& samples) {
  int kept = 0;
  for (int i = 0; i < samples.count; ++i) {
    if (z < problem.visibility.lowest_visible(samples.view[i], column, row)) continue;
    samples.view[kept] = samples.view[i];
    samples.pixel[kept++] = samples.pixel[i];
  }
  samples.count = kept;
}

// Matching cost of a cell at plane k; infinity outside the planes searched there.
double cost_at(const SweepProblem& problem, int column, int row, int k) {
  if (!problem.planes_at(column, row).contains(k)) return kInfinity;
  const Vec2d cell = problem.grid.cell_center(column, row);
  const Vec3d point{cell.x, cell.y, k * problem.dz_m};
  const bool patches = problem.options.cost != MatchingCost::sad;
  ViewSamples samples = views_showing(problem, point);
  if (patches) keep_showing_patch(problem, point, samples);
  const bool shown = samples.count >= problem.options.min_views;
  if (problem.visibility.any()) keep_unhidden(problem, column, row, static_cast<float>(point.z), samples);
  if (!patches) sample_windows(problem, samples);
  const double cost = patches ? patch_cost(problem, point, samples) : matching_cost(samples, problem.options);
  return cost == kInfinity && shown && problem.visibility.any() ? problem.options.hidden_cost : cost;
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
