// SPDX-License-Identifier: Apache-2.0
#include "sweep/horizons.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

class Marcher {
 public:
  Marcher(const Grid& grid, const HorizonQuestion& question) : grid_(grid), question_(question) {
    for (const float z : question.surface_m)
      if (!std::isnan(z)) highest_ = std::max(highest_, z - question.tolerance_m);
  }

  // One step moves one cell along the longer of the two grid axes; the nearest cell is looked at.
  float lowest_visible(Vec3d eye, int column, int row) const {
    const Vec2d cell = grid_.cell_center(column, row);
    const double dx = (eye.x - cell.x) / grid_.cell_m, dy = (cell.y - eye.y) / grid_.cell_m;
    const double steps = std::max(std::abs(dx), std::abs(dy));
    double lowest = question_.lowest_m;
    for (int i = 1 + question_.skipped_cells; i < steps; ++i) {
      const double t = i / steps;
      // A line from (cell, z) passes step i at z + t (eye.z - z): the z with which it just clears a height there.
      const auto clearing = [&](double height) { return (height - t * eye.z) / (1 - t); };
      if (clearing(highest_) <= lowest) break;  // it only rises from here
      const int x = static_cast<int>(std::lround(column + t * dx)), y = static_cast<int>(std::lround(row + t * dy));
      if (!question_.surface_m.contains(x, y)) break;
      const float height = question_.surface_m(x, y);
      if (!std::isnan(height)) lowest = std::max(lowest, clearing(height - question_.tolerance_m));
    }
    return lowest > question_.lowest_m ? static_cast<float>(lowest) : kNothing;
  }

 private:
  const Grid& grid_;
  const HorizonQuestion& question_;
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Horizons::Horizons(const Grid& grid, const std::vector<View>& views, const HorizonQuestion& question,
                   Executor& executor)
    : lowest_(views.size(), Array2d<float>(grid.width, grid.height, kNothing)) {
  const Marcher marcher(grid, question);
  executor.parallel_for(grid.height, [&](int row) {
    for (int column = 0; column < grid.width; ++column) {
      if (!question.wanted(column, row)) continue;
      for (std::size_t v = 0; v < views.size(); ++v)
        lowest_[v](column, row) = marcher.lowest_visible(views[v].camera.pose().center, column, row);
    }
  });
}

}  // namespace skysweep::sweep
