// SPDX-License-Identifier: Apache-2.0
#include "sweep/guide_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace skysweep::sweep {
namespace {

constexpr int kViews = 5;

// Those whose centres of projection lie nearest to the nadir line of a point, seen from above it.
std::vector<int> views_by_nadir_angle(const SweepProblem& problem, Vec2d place) {
  std::vector<int> order(problem.views.size());
  std::iota(order.begin(), order.end(), 0);
  const auto slope = [&](int v) {
    const Vec3d center = problem.views[v].camera.pose().center;
    return norm(Vec2d{center.x - place.x, center.y - place.y}) / std::max(1e-9, std::abs(center.z));
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return slope(a) < slope(b); });
  return order;
}

std::uint8_t luminance(const View& view, Vec2d pixel) {
  const Rgb8 c = view.image->sample_color(pixel, std::min(view.base_level, view.image->levels() - 1));
  return static_cast<std::uint8_t>(std::lround(0.212671 * c.r + 0.715160 * c.g + 0.072169 * c.b));
}

std::uint8_t median_luminance(const SweepProblem& problem, const std::vector<int>& order, Vec3d point) {
  std::array<std::uint8_t, kViews> seen{};
  int count = 0;
  for (const int v : order) {
    const std::optional<Vec2d> pixel = problem.views[v].camera.project(point);
    if (!pixel || !problem.views[v].camera.shows(*pixel)) continue;
    seen[count++] = luminance(problem.views[v], *pixel);
    if (count == kViews) break;
  }
  if (count == 0) return 0;
  std::nth_element(seen.begin(), seen.begin() + count / 2, seen.begin() + count);
  return std::max<std::uint8_t>(1, seen[count / 2]);
}

}  // namespace

Array2d<std::uint8_t> guide_image(const SweepProblem& problem, const MatchResult& found, int times,
                                  Executor& executor) {
  const Grid& grid = problem.grid;
  Array2d<std::uint8_t> guide(grid.width, grid.height, 0);
  executor.parallel_for(blocks_across(grid.height), [&](int by) {
    for (int bx = 0; bx < blocks_across(grid.width); ++bx) {
      const int x = bx * kBlockCells, y = by * kBlockCells;
      const int right = std::min(grid.width, x + kBlockCells), bottom = std::min(grid.height, y + kBlockCells);
      const std::vector<int> order = views_by_nadir_angle(problem, grid.cell_center((x + right) / 2, (y + bottom) / 2));
      for (int row = y; row < bottom; ++row) {
        for (int column = x; column < right; ++column) {
          if (!std::isfinite(found.cost(column / times, row / times))) continue;
          const Vec2d cell = grid.cell_center(column, row);
          const double z = found.plane(column / times, row / times) * times * problem.dz_m;
          guide(column, row) = median_luminance(problem, order, {cell.x, cell.y, z});
        }
      }
    }
  });
  return guide;
}

}  // namespace skysweep::sweep
