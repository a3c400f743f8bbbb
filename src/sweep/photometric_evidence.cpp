// SPDX-License-Identifier: Apache-2.0
#include "sweep/photometric_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {

int views_that_show(const SweepProblem& problem, Vec3d point) {
  return static_cast<int>(std::count_if(problem.views.begin(), problem.views.end(), [&](const View& view) {
    const auto pixel = view.camera.project(point);
    return pixel && view.camera.shows(*pixel);
  }));
}

// few_views_penalty / n at a plane; nothing where too few views show the cell for it to have a cost.
std::optional<double> penalty_at(const SweepProblem& problem, Vec2d cell, int k) {
  const int n = views_that_show(problem, {cell.x, cell.y, k * problem.dz_m});
  if (n < problem.options.min_views) return std::nullopt;
  return problem.options.few_views_penalty / n;
}

double mean_penalty(const SweepProblem& problem, Vec2d cell, const PlaneSet& planes) {
  double sum = 0;
  int counted = 0;
  for (const PlaneRange& range : planes.ranges()) {
    for (int k = range.first; k <= range.last; ++k) {
      if (const auto penalty = penalty_at(problem, cell, k)) {
        sum += *penalty;
        ++counted;
      }
    }
  }
  return counted > 0 ? sum / counted : 0;
}

bool has_evidence(const SweepProblem& problem, const MatchResult& matches, int column, int row) {
  const SweepOptions& options = problem.options;
  const double cost = matches.cost(column, row), mean = matches.mean_cost(column, row);
  const double least_penalty = options.few_views_penalty / std::max<std::size_t>(2, problem.views.size());
  const double largest_penalty = options.few_views_penalty / options.min_views;
  // However the views come and go: no need to count them. True of all but weak texture.
  if (cost - least_penalty < options.max_cost_to_mean * (mean - largest_penalty)) return true;
  const Vec2d cell = problem.grid.cell_center(column, row);
  const double own = penalty_at(problem, cell, matches.plane(column, row)).value_or(largest_penalty);
  // Costs come in single precision: what is left of them below this is rounding.
  const double rounding = 1e-5 * (1 + mean);
  const double photometric_mean = mean - mean_penalty(problem, cell, problem.planes_at(column, row));
  return cost - own + rounding < options.max_cost_to_mean * photometric_mean;
}

}  // namespace

void drop_heights_without_evidence(const SweepProblem& problem, const MatchResult& matches, Executor& executor,
                                   Heights& heights) {
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  if (problem.options.max_cost_to_mean >= 1) return;  // everything is to be believed
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int column = 0; column < problem.grid.width; ++column) {
      if (std::isnan(heights.height_m(column, row)) || has_evidence(problem, matches, column, row)) continue;
      heights.height_m(column, row) = heights.sigma_m(column, row) = kNoData;
    }
  });
}

}  // namespace skysweep::sweep
