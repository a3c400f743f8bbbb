// SPDX-License-Identifier: Apache-2.0
#include "sweep/hidden_cells.h"

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

}  // namespace skysweep::sweep
