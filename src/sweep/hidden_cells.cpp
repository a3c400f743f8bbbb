// SPDX-License-Identifier: Apache-2.0
#include "sweep/hidden_cells.h"

#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {
constexpr int kShownPerSeen = 2;
}

bool is_hidden(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row, double z) {
  const Vec2d cell = problem.grid.cell_center(column, row);
  int shown = 0, seen = 0;
  for (const View& view : problem.views) {
    const auto pixel = view.camera.project({cell.x, cell.y, z});
    if (!pixel || !view.camera.shows(*pixel)) continue;
    ++shown;
    seen += surface.sees(view.camera.pose().center, column, row, z);
    if (seen >= problem.options.min_views) return false;
  }
  return shown >= kShownPerSeen * problem.options.min_views;
}

void drop_hidden_heights(const SweepProblem& problem, Executor& executor, Heights& heights) {
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  const Array2d<float> before = heights.height_m;
  const SurfaceVisibility surface(problem.grid, before, kOcclusionTolerancePlanes * problem.dz_m);
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int column = 0; column < problem.grid.width; ++column) {
      const float z = before(column, row);
      if (std::isnan(z) || !is_hidden(problem, surface, column, row, z)) continue;
      heights.height_m(column, row) = heights.sigma_m(column, row) = kNoData;
    }
  });
}

}  // namespace skysweep::sweep
