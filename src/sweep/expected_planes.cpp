// SPDX-License-Identifier: Apache-2.0
#include "sweep/expected_planes.h"

#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {

// Coarse cells around one that are averaged, as far as they lie within so many coarse planes of it for each cell of
// distance: one surface, however steep, not both sides of a step.
constexpr int kRadius = 2;
constexpr double kSteepestPlanes = 1.5;

bool sure(const MatchResult& found, double sure_excess, int column, int row) {
  return std::isfinite(found.fraction(column, row)) && found.rival_excess(column, row) >= 0.5 * sure_excess;
}

double plane_at(const MatchResult& found, int column, int row) {
  return found.plane(column, row) + static_cast<double>(found.fraction(column, row));
}

// Least-squares plane through the sure cells around (column, row) that belong to its surface, at an offset from it in
// coarse cells. The cells come in all directions or not: a term that they do not fix is left out.
struct LocalPlane {
  double mean = 0, mean_x = 0, mean_y = 0, slope_x = 0, slope_y = 0;
  double at(double x, double y) const { return mean + slope_x * (x - mean_x) + slope_y * (y - mean_y); }
};

LocalPlane plane_around(const MatchResult& found, double sure_excess, int column, int row) {
  const double own = plane_at(found, column, row);
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      if (!found.plane.contains(column + dx, row + dy) || !sure(found, sure_excess, column + dx, row + dy)) continue;
      const double height = plane_at(found, column + dx, row + dy) - own;
      if (std::abs(height) > kSteepestPlanes * (1 + std::max(std::abs(dx), std::abs(dy)))) continue;
      n += 1, x += dx, y += dy, z += height;
      xx += dx * dx, xy += dx * dy, yy += dy * dy, xz += dx * height, yz += dy * height;
    }
  }
  LocalPlane plane{own + z / n, x / n, y / n};
  xx -= x * x / n, xy -= x * y / n, yy -= y * y / n, xz -= x * z / n, yz -= y * z / n;
  const double determinant = xx * yy - xy * xy;
  if (determinant < 1) return plane;
  plane.slope_x = (xz * yy - yz * xy) / determinant;
  plane.slope_y = (yz * xx - xz * xy) / determinant;
  return plane;
}

}  // namespace

Array2d<float> expected_planes(const MatchResult& found, int times, const SweepProblem& problem) {
  SKY_CHECK(times == 1 || times == 2);
  Array2d<float> expected(problem.grid.width, problem.grid.height, std::numeric_limits<float>::quiet_NaN());
  const double sure_excess = problem.options.sure_excess, off_center = times == 1 ? 0 : 0.25;
  for (int row = 0; row < found.plane.height(); ++row) {
    for (int column = 0; column < found.plane.width(); ++column) {
      if (!sure(found, sure_excess, column, row)) continue;
      const LocalPlane plane = plane_around(found, sure_excess, column, row);
      for (int y = 0; y < times; ++y)
        for (int x = 0; x < times; ++x)
          if (expected.contains(times * column + x, times * row + y))
            expected(times * column + x, times * row + y) =
                static_cast<float>(times * plane.at(0.5 * x - off_center, 0.5 * y - off_center));
    }
  }
  return expected;
}

}  // namespace skysweep::sweep
