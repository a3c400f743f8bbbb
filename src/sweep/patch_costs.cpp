// SPDX-License-Identifier: Apache-2.0
#include "sweep/patch_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/sampling_level.h"

namespace skysweep::sweep {
namespace {

using Patch = std::vector<double>;

double product(const Patch& a, const Patch& b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}

void add(double weight, const Patch& patch, Patch& sum) {
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weight * patch[j];
}

Patch luminance_around(const SweepProblem& problem, const View& view, Vec3d point, int window_level) {
  const int radius = problem.options.patch_radius_cells;
  const double step = problem.grid.cell_m * (1 << window_level);
  Patch patch;
  for (int south = -radius; south <= radius; ++south)
    for (int east = -radius; east <= radius; ++east) {
      const auto pixel = view.camera.project({point.x + east * step, point.y - south * step, point.z});
      patch.push_back(view.image->sample_luminance(*pixel, sampling_level(view, window_level)));
    }
  return patch;
}

void normalize(Patch& patch) {
  double mean = 0, squares = 0;
  for (const double x : patch) mean += x / static_cast<double>(patch.size());
  for (double& x : patch) x -= mean, squares += x * x;
  const double length = std::sqrt(squares + static_cast<double>(patch.size()) * kPatchFloor * kPatchFloor);
  for (double& x : patch) x /= length;
}

void take_census(Patch& patch) {
  const double middle = patch[patch.size() / 2], length = std::sqrt(static_cast<double>(patch.size()) - 1);
  for (double& x : patch) x = std::clamp((x - middle) / kCensusRamp, -1.0, 1.0) / length;
}

// The patches of all window levels one after the other, divided so that squares of lengths become their mean.
Patch descriptor(const SweepProblem& problem, const View& view, Vec3d point) {
  const SweepOptions& options = problem.options;
  const int levels = options.window_level_max - options.window_level_min + 1;
  Patch all;
  for (int level = options.window_level_min; level <= options.window_level_max; ++level) {
    Patch patch = luminance_around(problem, view, point, level);
    options.cost == MatchingCost::census ? take_census(patch) : normalize(patch);
    for (const double x : patch) all.push_back(x / std::sqrt(levels));
  }
  return all;
}

// Mean difference of the pairs, weighted.
double weighted_difference(const std::vector<Patch>& patches, const std::array<double, kMaxViews>& weights) {
  Patch sum(patches.front().size(), 0);
  double total = 0, squares = 0, lengths = 0;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    add(weights[k], patches[k], sum);
    total += weights[k];
    squares += weights[k] * weights[k];
    lengths += weights[k] * product(patches[k], patches[k]);
  }
  return (total * lengths - product(sum, sum)) / (total * total - squares);
}

}  // namespace

void keep_showing_patch(const SweepProblem& problem, Vec3d point, ViewSamples& samples) {
  const int reach = patch_reach(problem.options);
  const double cell = problem.grid.cell_m;
  const auto shows_all = [&](const camera::Camera& camera) {
    for (int south = -reach; south <= reach; ++south)
      for (int east = -reach; east <= reach; ++east) {
        const auto pixel = camera.project({point.x + east * cell, point.y - south * cell, point.z});
        if (!pixel || !camera.shows(*pixel)) return false;
      }
    return true;
  };
  int kept = 0;
  for (int i = 0; i < samples.count; ++i) {
    if (!shows_all(problem.views[samples.view[i]].camera)) continue;
    samples.view[kept] = samples.view[i];
    samples.pixel[kept++] = samples.pixel[i];
  }
  samples.count = kept;
}

double patch_cost(const SweepProblem& problem, Vec3d point, const ViewSamples& samples) {
  const SweepOptions& options = problem.options;
  const int n = samples.count;
  if (n < options.min_views) return std::numeric_limits<double>::infinity();
  std::vector<Patch> patches;
  for (int i = 0; i < n; ++i) patches.push_back(descriptor(problem, problem.views[samples.view[i]], point));
  Patch sum(patches.front().size(), 0);
  double lengths = 0;
  for (const Patch& patch : patches) {
    add(1, patch, sum);
    lengths += product(patch, patch);
  }
  std::array<double, kMaxViews> costs{};
  for (int k = 0; k < n; ++k)
    costs[k] = kPatchCostGrey * (lengths + n * product(patches[k], patches[k]) - 2 * product(patches[k], sum)) /
               (2.0 * (n - 1));
  const double penalty = options.few_views_penalty / n;
  switch (options.aggregation) {
    case Aggregation::all_views: return mean_of_lowest(costs, n, n) + penalty;
    case Aggregation::better_half: return mean_of_lowest(costs, n, std::max(1, n / 2)) + penalty;
    case Aggregation::consensus:
      return kPatchCostGrey * weighted_difference(patches, consensus_weights(costs, n, options.consensus_share)) +
             penalty;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace skysweep::sweep
