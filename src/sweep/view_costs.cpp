// SPDX-License-Identifier: Apache-2.0
#include "sweep/view_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/sampling_level.h"

namespace skysweep::sweep {
namespace {

using Costs = std::array<double, kMaxViews>;

// Mean difference of the pairs of views, weighted by how near their C_k are to being one of the lowest.
double difference_within_consensus(const ViewSamples& samples, const Costs& costs, double share) {
  const Costs weights = consensus_weights(costs, samples.count, share);
  double sum = 0, total = 0;
  for (int i = 0; i < samples.count; ++i) {
    for (int k = i + 1; k < samples.count; ++k) {
      const double both = weights[i] * weights[k];
      if (both == 0) continue;
      sum += both * samples.difference(i, k);
      total += both;
    }
  }
  return sum / total;
}

}  // namespace

double mean_of_lowest(std::array<double, kMaxViews> costs, int count, int used) {
  std::sort(costs.begin(), costs.begin() + count);
  double sum = 0;
  for (int k = 0; k < used; ++k) sum += costs[k];
  return sum / used;
}

std::array<double, kMaxViews> consensus_weights(const std::array<double, kMaxViews>& costs, int count, double share) {
  Costs sorted = costs, weights{};
  std::sort(sorted.begin(), sorted.begin() + count);
  const double limit = sorted[consensus_size(count, share) - 1];
  const double reach = kConsensusSoftness * limit + kConsensusSoftnessGrey;
  for (int k = 0; k < count; ++k) weights[k] = std::clamp(1 - (costs[k] - limit) / reach, 0.0, 1.0);
  return weights;
}

int consensus_size(int n, double share) {
  const int size = static_cast<int>(std::ceil(n * share - kShareSlack));
  return std::max(size, std::min(n, kSmallestConsensus));
}

double ViewSamples::difference(int i, int k) const {
  double sum = 0;
  for (int level = 0; level < levels; ++level) sum += std::abs(luminance[level][i] - luminance[level][k]);
  return sum / levels;
}

ViewSamples views_showing(const SweepProblem& problem, Vec3d point) {
  ViewSamples out;
  for (int v = 0; v < static_cast<int>(problem.views.size()); ++v) {
    const camera::Camera& camera = problem.views[v].camera;
    const std::optional<Vec2d> pixel = camera.project(point);
    if (!pixel || !camera.shows(*pixel)) continue;
    out.view[out.count] = v;
    out.pixel[out.count] = *pixel;
    ++out.count;
  }
  return out;
}

void sample_windows(const SweepProblem& problem, ViewSamples& samples) {
  const SweepOptions& options = problem.options;
  samples.levels = options.window_level_max - options.window_level_min + 1;
  for (int k = 0; k < samples.count; ++k) {
    const View& view = problem.views[samples.view[k]];
    for (int level = 0; level < samples.levels; ++level)
      samples.luminance[level][k] =
          view.gain *
              view.image->sample_luminance(samples.pixel[k], sampling_level(view, options.window_level_min + level)) +
          view.offset;
  }
}

ViewSamples sample_views(const SweepProblem& problem, Vec3d point) {
  ViewSamples samples = views_showing(problem, point);
  sample_windows(problem, samples);
  return samples;
}

std::array<double, kMaxViews> view_costs(const ViewSamples& samples) {
  Costs costs{}, differences;
  for (int i = 0; i < samples.count; ++i) {
    // As ViewSamples::difference, level after level for all other views at once.
    for (int k = i + 1; k < samples.count; ++k) differences[k] = 0;
    for (int level = 0; level < samples.levels; ++level) {
      const Costs& luminance = samples.luminance[level];
      for (int k = i + 1; k < samples.count; ++k) differences[k] += std::abs(luminance[i] - luminance[k]);
    }
    double own = costs[i];
    for (int k = i + 1; k < samples.count; ++k) {
      differences[k] /= samples.levels;
      costs[k] += differences[k];
    }
    for (int k = i + 1; k < samples.count; ++k) own += differences[k];
    costs[i] = own;
  }
  for (int k = 0; k < samples.count && samples.count > 1; ++k) costs[k] /= samples.count - 1;
  return costs;
}

double matching_cost(const ViewSamples& samples, const SweepOptions& options) {
  const int n = samples.count;
  if (n < options.min_views) return std::numeric_limits<double>::infinity();
  const Costs costs = view_costs(samples);
  const double penalty = options.few_views_penalty / n;
  switch (options.aggregation) {
    case Aggregation::all_views: return mean_of_lowest(costs, n, n) + penalty;
    case Aggregation::better_half: return mean_of_lowest(costs, n, std::max(1, n / 2)) + penalty;
    case Aggregation::consensus: return difference_within_consensus(samples, costs, options.consensus_share) + penalty;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace skysweep::sweep
