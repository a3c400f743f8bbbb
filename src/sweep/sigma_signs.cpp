// SPDX-License-Identifier: Apache-2.0
#include "sweep/sigma_signs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sweep/ray_geometry.h"
#include "sweep/window_statistics.h"

namespace skysweep::sweep {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename Convert>
Array2d<float> converted(const Array2d<float>& values, Convert convert) {
  Array2d<float> out(values.width(), values.height());
  std::transform(values.begin(), values.end(), out.begin(), convert);
  return out;
}

Array2d<float> rival_excess(const SweepProblem& problem, const MatchResult& matches, const Array2d<float>& height_m) {
  const bool known = problem.options.smoothing != Smoothing::none;
  Array2d<float> out(height_m.width(), height_m.height(), 0);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (known && !std::isnan(height_m.data()[i]))
      out.data()[i] = std::min(kLargestExcess, matches.rival_excess.data()[i]);
  return out;
}

Array2d<float> height_per_pixel_of_cells(const SweepProblem& problem, const Array2d<float>& height_m) {
  const Array2d<double> blocks = height_per_pixel(problem, height_m);
  Array2d<float> out(height_m.width(), height_m.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out(x, y) = static_cast<float>(blocks(x / kBlockCells, y / kBlockCells));
  return out;
}

Array2d<float> offset_from_mean(const Array2d<float>& height_m) {
  Array2d<float> out = window_mean(height_m, 4);
  std::transform(height_m.begin(), height_m.end(), out.begin(), out.begin(),
                 [](float z, float mean) { return std::abs(z - mean); });
  return out;
}

}  // namespace

SigmaSigns sigma_signs(const SweepProblem& problem, const MatchResult& matches, const Array2d<float>& height_m,
                       EdgeEvidence edges) {
  const Array2d<float> excess = rival_excess(problem, matches, height_m);
  const auto undecided = converted(excess, [](float e) { return e < kUndecidedExcess ? 1.0f : 0.0f; });
  const auto cost = converted(matches.cost, [](float c) { return std::isfinite(c) ? c : kNaN; });
  const auto bend = converted(matches.bend, [](float b) { return b > 0 ? b : kNaN; });
  return {height_per_pixel_of_cells(problem, height_m),
          window_range(height_m, 2),
          window_range(height_m, 8),
          offset_from_mean(height_m),
          window_mean(excess, 1),
          window_mean(excess, 4),
          window_mean(undecided, 8),
          window_mean(bend, 4),
          window_mean(cost, 4),
          window_mean(cost, 8),
          std::move(edges)};
}

}  // namespace skysweep::sweep
