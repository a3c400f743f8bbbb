// SPDX-License-Identifier: Apache-2.0
#include "sweep/ray_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace skysweep::sweep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double median_of_block(const Array2d<float>& height_m, int bx, int by) {
  std::vector<float> known;
  for (int y = by * kBlockCells; y < std::min(height_m.height(), (by + 1) * kBlockCells); ++y)
    for (int x = bx * kBlockCells; x < std::min(height_m.width(), (bx + 1) * kBlockCells); ++x)
      if (!std::isnan(height_m(x, y))) known.push_back(height_m(x, y));
  if (known.empty()) return kNaN;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return *middle;
}

double height_per_pixel_at(const SweepProblem& problem, Vec3d place) {
  double n = 0, gsd = 0, x = 0, y = 0, squares = 0;
  for (const View& view : problem.views) {
    const auto pixel = view.camera.project(place);
    if (!pixel || !view.camera.shows(*pixel)) continue;
    const Vec3d to_view = view.camera.pose().center - place;
    if (!(to_view.z > 0)) continue;
    const double east = to_view.x / to_view.z, north = to_view.y / to_view.z;
    n += 1;
    // What a pixel covers of level ground, along the direction in which heights move it.
    const double depth = view.camera.depth(place);
    gsd += view.camera.gsd(depth) * depth / to_view.z;
    x += east, y += north, squares += east * east + north * north;
  }
  if (n < 2) return kNaN;
  const double spread = squares - (x * x + y * y) / n;
  return spread > 0 ? gsd / n / std::sqrt(spread) : kNaN;
}

}  // namespace

Array2d<double> height_per_pixel(const SweepProblem& problem, const Array2d<float>& height_m) {
  Array2d<double> out(blocks_across(problem.grid.width), blocks_across(problem.grid.height), kNaN);
  for (int by = 0; by < out.height(); ++by) {
    for (int bx = 0; bx < out.width(); ++bx) {
      const double z = median_of_block(height_m, bx, by);
      if (std::isnan(z)) continue;
      const int column = std::min(problem.grid.width - 1, bx * kBlockCells + kBlockCells / 2);
      const int row = std::min(problem.grid.height - 1, by * kBlockCells + kBlockCells / 2);
      const Vec2d center = problem.grid.cell_center(column, row);
      out(bx, by) = height_per_pixel_at(problem, {center.x, center.y, z});
    }
  }
  return out;
}

}  // namespace skysweep::sweep
