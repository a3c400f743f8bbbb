// SPDX-License-Identifier: Apache-2.0
#include "sweep/orthophoto.h"

#include <algorithm>
#include <cmath>

#include "sweep/color_candidates.h"
#include "sweep/exposure.h"
#include "sweep/view_choice.h"

namespace skysweep::sweep {
namespace {

// Sixteenths of a grey level that a colour may be off the median of all to count for the mean: more is something else,
// a car that has left or a wrong height.
constexpr int kLargestDeviationOfMean = 12 * 16;

struct Colored {
  int view = -1;
  Vec2d pixel;
};

// The view that shows the point nearest its image centre, as a share of the image's size.
Colored nearest_image_center(const SweepProblem& problem, Vec3d point) {
  Colored best;
  double best_distance = 0;
  for (int v = 0; v < static_cast<int>(problem.views.size()); ++v) {
    const camera::Camera& camera = problem.views[v].camera;
    const std::optional<Vec2d> pixel = camera.project(point);
    if (!pixel || !camera.shows(*pixel)) continue;
    const Vec2d from_center{pixel->x / camera.model().width_px - 0.5, pixel->y / camera.model().height_px - 0.5};
    if (best.view >= 0 && norm(from_center) >= best_distance) continue;
    best = {v, *pixel};
    best_distance = norm(from_center);
  }
  return best;
}

// Mean of the candidates that agree with the median of all; that of the chosen one if none does.
Rgb8 mean_color(const CellCandidates& cell, Rgb8 chosen) {
  const std::array<std::uint16_t, kMostCandidates> deviation = deviations(cell);
  int r = 0, g = 0, b = 0, n = 0;
  for (int i = 0; i < cell.count; ++i) {
    if (deviation[i] > kLargestDeviationOfMean) continue;
    r += cell.of[i].color.r, g += cell.of[i].color.g, b += cell.of[i].color.b, ++n;
  }
  const auto rounded = [n](int sum) { return static_cast<std::uint8_t>((2 * sum + n) / (2 * n)); };
  return n > 0 ? Rgb8{rounded(r), rounded(g), rounded(b)} : chosen;
}

constexpr Rgba8 opaque(Rgb8 c) { return {c.r, c.g, c.b, 255}; }

// Cells without height of the core, from the plane.
void color_plane(const SweepProblem& problem, double z, Executor& executor, SweepResult& result) {
  const int collar = problem.collar_cells;
  executor.parallel_for(problem.grid.height - 2 * collar, [&](int core_row) {
    const int row = collar + core_row;
    for (int column = collar; column < problem.grid.width - collar; ++column) {
      if (!std::isnan(result.height_m(column, row))) continue;
      const Vec2d cell = problem.grid.cell_center(column, row);
      const Colored from = nearest_image_center(problem, {cell.x, cell.y, z});
      if (from.view < 0) continue;
      result.planar(column, row) = 1;
      result.color(column, row) = opaque(color_at(problem.views[from.view], from.pixel));
      result.color_view(column, row) = static_cast<std::int8_t>(from.view);
    }
  });
}

}  // namespace

void colorize(const SweepProblem& problem, Executor& executor, SweepResult& result) {
  const int width = problem.grid.width, height = problem.grid.height, collar = problem.collar_cells;
  const SweepOptions& options = problem.options;
  result.color = Array2d<Rgba8>(width, height);
  result.color_view = Array2d<std::int8_t>(width, height, -1);
  result.planar = Array2d<std::uint8_t>(width, height, 0);
  result.view_count = Array2d<std::uint8_t>(width, height, 0);

  const CoreWithMargin region(problem, kChoiceReach);
  Array2d<CellCandidates> cells = color_candidates(problem, result.height_m, region, executor);
  if (options.compensate_exposure) {
    const std::vector<LogGain> gains = estimate_exposures(cells, static_cast<int>(problem.views.size()));
    if (!gains.empty()) equalize_exposures(problem, result.height_m, region, gains, executor, cells);
  }
  const Array2d<std::int8_t> chosen = choose_views(cells, options.seam_cost, executor);

  executor.parallel_for(height - 2 * collar, [&](int core_row) {
    const int row = collar + core_row, y = row - region.first_row;
    for (int column = collar; column < width - collar; ++column) {
      const int x = column - region.first_column;
      const CellCandidates& cell = cells(x, y);
      result.view_count(column, row) = cell.seen_by;
      if (chosen(x, y) < 0) continue;
      const ColorCandidate& from = cell.of[chosen(x, y)];
      result.color(column, row) =
          opaque(options.orthophoto == Orthophoto::mean ? mean_color(cell, from.color) : from.color);
      result.color_view(column, row) = from.view;
    }
  });
  const PlaneRange planes = problem.all_planes();
  if (options.planar_fallback && !planes.empty()) color_plane(problem, planes.first * problem.dz_m, executor, result);
}

}  // namespace skysweep::sweep
