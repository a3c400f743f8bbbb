// SPDX-License-Identifier: Apache-2.0
#include "sweep/orthophoto.h"

#include <algorithm>
#include <cmath>

#include "sweep/hidden_cells.h"
#include "sweep/view_costs.h"
#include "sweep/visibility.h"

namespace skysweep::sweep {
namespace {

struct Colored {
  int view = -1;
  Vec2d pixel;
};

// Leaves the views to whose cameras the surface lets the cell look up.
void drop_hidden(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row, double z,
                 ViewSamples& samples) {
  int kept = 0;
  for (int k = 0; k < samples.count; ++k) {
    if (!surface.sees(problem.views[samples.view[k]].camera.pose().center, column, row, z)) continue;
    samples.view[kept] = samples.view[k];
    samples.pixel[kept] = samples.pixel[k];
    ++kept;
  }
  samples.count = kept;
}

// Among the views that show the point and are not hidden from it, the one that differs least from the others.
Colored best_unoccluded(const SweepProblem& problem, const SurfaceVisibility& surface, int column, int row, Vec3d point,
                        int& shown_by) {
  ViewSamples samples = views_showing(problem, point);
  drop_hidden(problem, surface, column, row, point.z, samples);
  shown_by = samples.count;
  if (samples.count == 0) return {};
  if (samples.count <= 2) return {samples.view[0], samples.pixel[0]};  // two differ from each other alike
  sample_windows(problem, samples);
  const std::array<double, kMaxViews> costs = view_costs(samples);
  const auto best = std::min_element(costs.begin(), costs.begin() + samples.count) - costs.begin();
  return {samples.view[best], samples.pixel[best]};
}

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

Rgba8 color_at(const SweepProblem& problem, const Colored& from) {
  const View& view = problem.views[from.view];
  const Rgb8 c = view.image->sample_color(from.pixel, std::min(view.base_level, view.image->levels() - 1));
  return {c.r, c.g, c.b, 255};
}

}  // namespace

void colorize(const SweepProblem& problem, Executor& executor, SweepResult& result) {
  const int width = problem.grid.width, height = problem.grid.height;
  result.color = Array2d<Rgba8>(width, height);
  result.color_view = Array2d<std::int8_t>(width, height, -1);
  result.planar = Array2d<std::uint8_t>(width, height, 0);
  result.view_count = Array2d<std::uint8_t>(width, height, 0);
  const SurfaceVisibility surface(problem.grid, result.height_m, kOcclusionTolerancePlanes * problem.dz_m);
  const PlaneRange planes = problem.all_planes();

  const int collar = problem.collar_cells;
  executor.parallel_for(height - 2 * collar, [&](int core_row) {
    const int row = collar + core_row;
    for (int column = collar; column < width - collar; ++column) {
      const Vec2d cell = problem.grid.cell_center(column, row);
      const float z = result.height_m(column, row);
      Colored from;
      if (!std::isnan(z)) {
        int shown_by = 0;
        from = best_unoccluded(problem, surface, column, row, {cell.x, cell.y, z}, shown_by);
        result.view_count(column, row) = static_cast<std::uint8_t>(shown_by);
      } else if (problem.options.planar_fallback && !planes.empty()) {
        from = nearest_image_center(problem, {cell.x, cell.y, planes.first * problem.dz_m});
        result.planar(column, row) = from.view >= 0;
      }
      if (from.view < 0) continue;
      result.color(column, row) = color_at(problem, from);
      result.color_view(column, row) = static_cast<std::int8_t>(from.view);
    }
  });
}

}  // namespace skysweep::sweep
