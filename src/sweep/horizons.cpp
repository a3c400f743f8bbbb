// SPDX-License-Identifier: Apache-2.0
#include "sweep/horizons.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/block_maxima.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

class Marcher {
 public:
  Marcher(const Grid& grid, const HorizonQuestion& question)
      : grid_(grid),
        question_(question),
        maxima_(question.surface_m),
        highest_(maxima_.highest() - question.tolerance_m) {}

  // One step moves one cell along the longer of the two grid axes; the nearest cell is looked at.
  float lowest_visible(Vec3d eye, int column, int row) const {
    const Vec2d cell = grid_.cell_center(column, row);
    const double dx = (eye.x - cell.x) / grid_.cell_m, dy = (cell.y - eye.y) / grid_.cell_m;
    const double steps = std::max(std::abs(dx), std::abs(dy));
    double lowest = question_.lowest_m;
    const BlockExit exit(dx / steps, dy / steps);
    const double per_step = 1 / steps;
    for (int i = 1 + question_.skipped_cells; i < steps;) {
      const double t = i * per_step;
      // Where the line from the lowest height known to be visible passes; from here on it only rises.
      const double line = lowest + t * (eye.z - lowest);
      if (highest_ <= line) break;
      const int x = rounded(column + t * dx), y = rounded(row + t * dy);
      if (!question_.surface_m.contains(x, y)) break;
      const double limit = line + question_.tolerance_m;
      const int clear = maxima_.clear_cells(x, y, [limit](float highest) { return highest <= limit; });
      if (clear > 0) {
        i += exit.steps(clear, x, y);
        continue;
      }
      const float height = question_.surface_m(x, y);
      // A line from (cell, z) passes step i at z + t (eye.z - z): the z with which it just clears this height.
      if (height > limit) lowest = (height - question_.tolerance_m - t * eye.z) / (1 - t);  // never of NaN
      ++i;
    }
    return lowest > question_.lowest_m ? static_cast<float>(lowest) : kNothing;
  }

 private:
  const Grid& grid_;
  const HorizonQuestion& question_;
  BlockMaxima maxima_;
  double highest_;
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
