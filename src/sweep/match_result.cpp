// SPDX-License-Identifier: Apache-2.0
#include "sweep/match_result.h"

#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
}  // namespace

MatchResult::MatchResult(int width, int height)
    : plane(width, height, 0),
      cost(width, height, kInfinity),
      mean_cost(width, height, kInfinity),
      fraction(width, height, kNaN),
      bend(width, height, kNaN),
      rival_plane(width, height, 0),
      rival_excess(width, height, kInfinity) {}

Parabola parabola_through(double below, double middle, double above) {
  const double bend = below - 2 * middle + above;
  if (!std::isfinite(bend) || !(bend > 0)) return {kNaN, kNaN};
  return {0.5 * (below - above) / bend, bend};
}

}  // namespace skysweep::sweep
