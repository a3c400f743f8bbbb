// SPDX-License-Identifier: Apache-2.0
#include "sweep/view_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/sampling_level.h"

namespace skysweep::sweep {

ViewCosts view_costs(const SweepProblem& problem, Vec3d point, const std::array<bool, kMaxViews>* use) {
  ViewCosts out;
  for (int v = 0; v < static_cast<int>(problem.views.size()); ++v) {
    if (use && !(*use)[v]) continue;
    const camera::Camera& camera = problem.views[v].camera;
    const std::optional<Vec2d> pixel = camera.project(point);
    if (!pixel || !camera.shows(*pixel)) continue;
    out.view[out.count] = v;
    out.pixel[out.count] = *pixel;
    ++out.count;
  }
  if (out.count < 2) return out;

  const SweepOptions& options = problem.options;
  for (int level = options.window_level_min; level <= options.window_level_max; ++level) {
    std::array<double, kMaxViews> luminance;
    for (int k = 0; k < out.count; ++k) {
      const View& view = problem.views[out.view[k]];
      luminance[k] = view.image->sample_luminance(out.pixel[k], sampling_level(view, level));
    }
    for (int k = 0; k < out.count; ++k)
      for (int i = 0; i < out.count; ++i) out.cost[k] += std::abs(luminance[i] - luminance[k]);
  }
  const double terms = (out.count - 1.0) * (options.window_level_max - options.window_level_min + 1);
  for (int k = 0; k < out.count; ++k) out.cost[k] /= terms;
  return out;
}

double aggregate(const ViewCosts& costs, const SweepOptions& options) {
  if (costs.count < options.min_views) return std::numeric_limits<double>::infinity();
  std::array<double, kMaxViews> cost = costs.cost;
  int used = costs.count;
  if (options.aggregation == Aggregation::better_half) {
    std::sort(cost.begin(), cost.begin() + used);
    used = std::max(1, used / 2);
  }
  double sum = 0;
  for (int k = 0; k < used; ++k) sum += cost[k];
  return sum / used;
}

}  // namespace skysweep::sweep
