// SPDX-License-Identifier: Apache-2.0
#include "sweep/point_colors.h"

#include <algorithm>
#include <cmath>

namespace skysweep::sweep {
namespace {

using Channels = std::array<std::array<float, kMaxViews>, 3>;

MeanColor median_of(const Channels& seen, int count) {
  MeanColor median{};
  std::array<float, kMaxViews> values;
  for (int c = 0; c < 3; ++c) {
    std::copy_n(seen[c].begin(), count, values.begin());
    std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
    median[c] = values[count / 2];
  }
  return median;
}

}  // namespace

double color_difference(const MeanColor& a, const MeanColor& b) {
  return (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 3.0;
}

bool CellSight::sees(int view, double z) {
  const Vec3d eye = problem_.views[view].camera.pose().center;
  double& lowest = lowest_visible_[view];
  if (std::isnan(lowest)) lowest = surface_.lowest_visible(eye, column_, row_, lowest_m_);
  return z >= lowest && z < eye.z;
}

PointColors point_colors(const SweepProblem& problem, CellSight& sight, double z, double largest_difference,
                         Vec2d offset_m) {
  const Vec2d cell = problem.grid.cell_center(sight.column(), sight.row());
  Channels seen;
  PointColors out;
  for (int v = 0; v < static_cast<int>(problem.views.size()); ++v) {
    const View& view = problem.views[v];
    const std::optional<Vec2d> pixel = view.camera.project({cell.x + offset_m.x, cell.y + offset_m.y, z});
    if (!pixel || !view.camera.shows(*pixel)) continue;
    if (!sight.sees(v, z)) {
      ++out.hidden_from;
      continue;
    }
    const Rgb8 color = view.image->sample_color(*pixel, std::min(view.base_level, view.image->levels() - 1));
    seen[0][out.seen_by] = color.r;
    seen[1][out.seen_by] = color.g;
    seen[2][out.seen_by] = color.b;
    ++out.seen_by;
  }
  if (out.seen_by == 0) return out;
  out.median = median_of(seen, out.seen_by);
  double sum = 0;
  for (int i = 0; i < out.seen_by; ++i)
    sum += std::min(color_difference({seen[0][i], seen[1][i], seen[2][i]}, out.median), largest_difference);
  out.spread = sum / out.seen_by;
  return out;
}

}  // namespace skysweep::sweep
