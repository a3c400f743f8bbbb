// SPDX-License-Identifier: Apache-2.0
#include "sweep/color_candidates.h"

#include <algorithm>
#include <cmath>

#include "sweep/hidden_cells.h"
#include "sweep/visibility.h"

namespace skysweep::sweep {
namespace {

struct Sight {
  double squared_slope;
  int view;
  Vec2d pixel;
};

// Inserts a view into the list of the steepest, the first of two alike first.
void keep_steepest(const Sight& sight, std::array<Sight, kMostCandidates>& steepest, int& count) {
  if (count == kMostCandidates && sight.squared_slope >= steepest[count - 1].squared_slope) return;
  int at = count < kMostCandidates ? count++ : kMostCandidates - 1;
  for (; at > 0 && steepest[at - 1].squared_slope > sight.squared_slope; --at) steepest[at] = steepest[at - 1];
  steepest[at] = sight;
}

CellCandidates candidates_of(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row,
                             Vec3d point) {
  CellCandidates out;
  std::array<Sight, kMostCandidates> steepest;
  int count = 0;
  for (int v = 0; v < static_cast<int>(problem.views.size()); ++v) {
    const camera::Camera& camera = problem.views[v].camera;
    const std::optional<Vec2d> pixel = camera.project(point);
    if (!pixel || !camera.shows(*pixel)) continue;
    const Vec3d center = camera.pose().center;
    if (!surface.sees(center, column, row, point.z)) continue;
    ++out.seen_by;
    const double dx = center.x - point.x, dy = center.y - point.y, dz = center.z - point.z;
    keep_steepest({(dx * dx + dy * dy) / (dz * dz), v, *pixel}, steepest, count);
  }
  out.count = static_cast<std::uint8_t>(count);
  for (int i = 0; i < count; ++i) {
    const Sight& sight = steepest[i];
    const double slope = std::min(255.0, kSlopeScale * std::sqrt(sight.squared_slope));
    out.of[i] = {color_at(problem.views[sight.view], sight.pixel), static_cast<std::int8_t>(sight.view),
                 static_cast<std::uint8_t>(slope)};
  }
  return out;
}

}  // namespace

const ColorCandidate* CellCandidates::find(int view) const {
  const ColorCandidate* found = std::find_if(begin(), end(), [view](const auto& c) { return c.view == view; });
  return found == end() ? nullptr : found;
}

CoreWithMargin::CoreWithMargin(const SweepProblem& problem, int margin) {
  const int cut = std::max(0, problem.collar_cells - margin);
  first_column = first_row = cut;
  width = problem.grid.width - 2 * cut;
  height = problem.grid.height - 2 * cut;
}

Array2d<CellCandidates> color_candidates(const SweepProblem& problem, const Array2d<float>& height_m,
                                         const CoreWithMargin& region, Executor& executor) {
  Array2d<CellCandidates> out(region.width, region.height);
  const SurfaceVisibility surface(problem.grid, height_m, kOcclusionTolerancePlanes * problem.dz_m);
  executor.parallel_for(region.height, [&](int y) {
    const int row = region.first_row + y;
    for (int x = 0; x < region.width; ++x) {
      const int column = region.first_column + x;
      const float z = height_m(column, row);
      if (std::isnan(z)) continue;
      const Vec2d cell = problem.grid.cell_center(column, row);
      out(x, y) = candidates_of(problem, surface, column, row, {cell.x, cell.y, z});
    }
  });
  return out;
}

Rgb8 color_at(const View& view, Vec2d pixel) {
  return view.image->sample_color(pixel, std::min(view.base_level, view.image->levels() - 1));
}

}  // namespace skysweep::sweep
