// SPDX-License-Identifier: Apache-2.0
#include "sweep/heights.h"

#include <cmath>
#include <limits>
#include <optional>

namespace skysweep::sweep {
namespace {

// Costs come in single precision: a bend of the curve below this share of the cost is rounding, not texture.
constexpr double kSmallestBend = 1e-5;

std::optional<double> height_of_cell(const SweepProblem& problem, const MatchResult& m, int column, int row) {
  const SweepOptions& options = problem.options;
  const double cost = m.cost(column, row), bend = m.bend(column, row);
  if (!std::isfinite(cost) || !(bend > kSmallestBend * (1 + cost))) return std::nullopt;
  if (cost > options.max_cost) return std::nullopt;
  const bool believe_everything = options.max_cost_to_mean >= 1;
  if (!believe_everything && cost > options.max_cost_to_mean * m.mean_cost(column, row)) return std::nullopt;
  return (m.plane(column, row) + m.fraction(column, row)) * problem.dz_m;
}

}  // namespace

Heights heights_from_matches(const SweepProblem& problem, const MatchResult& matches) {
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  const int width = problem.grid.width, height = problem.grid.height;
  Heights out{Array2d<float>(width, height, kNoData), Array2d<float>(width, height, kNoData)};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      if (const auto z = height_of_cell(problem, matches, column, row))
        out.height_m(column, row) = static_cast<float>(*z);
    }
  }
  return out;
}

}  // namespace skysweep::sweep
