// SPDX-License-Identifier: Apache-2.0
#include "sweep/photometric_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/shown_planes.h"

namespace skysweep::sweep {
namespace {

// few_views_penalty / n, averaged over the planes at which enough views show the place for it to have a cost.
double mean_penalty(const SweepOptions& options, const ShownPlanes& shown, const PlaneSet& planes) {
  double sum = 0;
  int counted = 0;
  for (const PlaneRange& range : planes.ranges()) {
    shown.for_each_run(range, [&](PlaneRange run, int views) {
      if (views < options.min_views) return;
      sum += run.count() * options.few_views_penalty / views;
      counted += run.count();
    });
  }
  return counted > 0 ? sum / counted : 0;
}

bool has_evidence(const SweepProblem& problem, const MatchResult& matches, int column, int row, double mean_error,
                  ShownPlanes& shown) {
  const SweepOptions& options = problem.options;
  const double cost = matches.cost(column, row), mean = matches.mean_cost(column, row);
  const double least_penalty = options.few_views_penalty / std::max<std::size_t>(2, problem.views.size());
  const double largest_penalty = options.few_views_penalty / options.min_views;
  // However the views come and go: no need to count them. True of all but weak texture.
  if (cost - least_penalty < options.max_cost_to_mean * (mean - largest_penalty)) return true;
  const PlaneSet& planes = problem.planes_at(column, row);
  shown.look_at(problem.grid.cell_center(column, row), planes.hull());
  const int n = shown.views_at(matches.plane(column, row));
  const double own = n < options.min_views ? largest_penalty : options.few_views_penalty / n;
  // Costs come in single precision: what is left of them below this is rounding.
  const double rounding = 1e-5 * (1 + mean) + mean_error;
  const double photometric_mean = mean - mean_penalty(options, shown, planes);
  return cost - own + rounding < options.max_cost_to_mean * photometric_mean;
}

}  // namespace

void drop_heights_without_evidence(const SweepProblem& problem, const MatchResult& matches, Executor& executor,
                                   Heights& heights, double mean_error) {
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  if (problem.options.max_cost_to_mean >= 1) return;  // everything is to be believed
  executor.parallel_for(problem.grid.height, [&](int row) {
    ShownPlanes shown(problem);
    for (int column = 0; column < problem.grid.width; ++column) {
      if (std::isnan(heights.height_m(column, row)) || has_evidence(problem, matches, column, row, mean_error, shown))
        continue;
      heights.height_m(column, row) = heights.sigma_m(column, row) = kNoData;
    }
  });
}

}  // namespace skysweep::sweep
