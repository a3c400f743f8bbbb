// SPDX-License-Identifier: Apache-2.0
#include "sweep/filling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sweep/hidden_cells.h"
#include "sweep/small_patches.h"

namespace skysweep::sweep {
namespace {

constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
// Heights of one surface differ by no more than the tolerance and this slope times their distance.
constexpr double kSteepestBackground = 0.5;
constexpr double kSameSurfacePlanes = 6;
// A single low height may be a false match: nothing is filled from it.
constexpr std::size_t kFewestAgreeing = 2;

struct Direction {
  int x, y;
};
constexpr std::array<Direction, 8> kDirections{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, 1}, {1, -1}, {-1, 1}}};

Array2d<std::uint16_t> steps_to_known(const Array2d<float>& height_m, Direction d) {
  const int width = height_m.width(), height = height_m.height();
  Array2d<std::uint16_t> steps(width, height, 0);
  // Against the direction, so that the next cell along it is always done already.
  for (int i = 0; i < height; ++i) {
    for (int j = 0; j < width; ++j) {
      const int column = d.x > 0 ? width - 1 - j : j, row = d.y > 0 ? height - 1 - i : i;
      const int x = column + d.x, y = row + d.y;
      if (!height_m.contains(x, y)) continue;
      if (!std::isnan(height_m(x, y)))
        steps(column, row) = 1;
      else if (steps(x, y) > 0)
        steps(column, row) = static_cast<std::uint16_t>(steps(x, y) + 1);
    }
  }
  return steps;
}

struct Met {
  double z, distance_m;
  Vec2d place_m;  // from the cell
};

double distance_weighted_mean(const std::vector<Met>& all) {
  double sum = 0, weights = 0;
  for (const Met& m : all) {
    sum += m.z / m.distance_m;
    weights += 1 / m.distance_m;
  }
  return sum / weights;
}

void close_small_gaps(int close_gap_cells, const Background& background, Array2d<float>& height_m,
                      Array2d<std::uint8_t>& filled) {
  Array2d<float> gaps(height_m.width(), height_m.height());
  std::transform(height_m.begin(), height_m.end(), gaps.begin(),
                 [](float z) { return std::isnan(z) ? 0.0f : kNoData; });
  for_each_small_patch(gaps, 0, close_gap_cells, [&](const Patch& gap) {
    for (const auto [column, row] : gap) {
      height_m(column, row) = background.height_at(column, row);
      filled(column, row) = !std::isnan(height_m(column, row));
    }
  });
}

}  // namespace

Background::Background(const Array2d<float>& height_m, double cell_m, double tolerance_m, Executor& executor)
    : height_m_(height_m), cell_m_(cell_m), tolerance_m_(tolerance_m), steps_(kDirections.size()) {
  const int longest = std::max(height_m.width(), height_m.height());
  SKY_CHECK_LE(longest, int{std::numeric_limits<std::uint16_t>::max()});
  executor.parallel_for(static_cast<int>(kDirections.size()),
                        [&](int i) { steps_[i] = steps_to_known(height_m, kDirections[i]); });
}

float Background::height_at(int column, int row) const {
  std::vector<Met> met;
  for (std::size_t i = 0; i < kDirections.size(); ++i) {
    const int steps = steps_[i](column, row);
    if (steps == 0) continue;
    const int x = steps * kDirections[i].x, y = steps * kDirections[i].y;
    const Vec2d place{x * cell_m_, y * cell_m_};
    met.push_back({height_m_(column + x, row + y), norm(place), place});
  }
  if (met.empty()) return kNoData;
  const Met lowest = *std::min_element(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.z < b.z; });
  std::erase_if(met, [&](const Met& m) {
    return m.z - lowest.z > tolerance_m_ + kSteepestBackground * norm(m.place_m - lowest.place_m);
  });
  if (met.size() < kFewestAgreeing) return kNoData;
  return static_cast<float>(distance_weighted_mean(met));
}

Array2d<std::uint8_t> fill_hidden_cells(const SweepProblem& problem, Executor& executor, Heights& heights) {
  Array2d<std::uint8_t> filled(problem.grid.width, problem.grid.height, 0);
  if (!problem.options.fill) return filled;
  const Array2d<float> measured = heights.height_m;
  const SurfaceVisibility surface(problem.grid, measured, kOcclusionTolerancePlanes * problem.dz_m);
  const Background background(measured, problem.grid.cell_m, kSameSurfacePlanes * problem.dz_m, executor);
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int column = 0; column < problem.grid.width; ++column) {
      if (!std::isnan(measured(column, row))) continue;
      const float z = background.height_at(column, row);
      if (std::isnan(z) || !is_hidden(problem, surface, column, row, z)) continue;
      heights.height_m(column, row) = z;
      filled(column, row) = 1;
    }
  });
  close_small_gaps(problem.options.close_gap_cells, background, heights.height_m, filled);
  return filled;
}

}  // namespace skysweep::sweep
