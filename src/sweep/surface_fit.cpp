// SPDX-License-Identifier: Apache-2.0
#include "sweep/surface_fit.h"

#include <algorithm>
#include <cmath>

namespace skysweep::sweep {
namespace {

constexpr int kRadius = 4;
// Added to the spread of the columns and rows, cells squared: few cells on one side must not tilt the plane.
constexpr double kRidge = 0.3;

}  // namespace

std::optional<double> fitted_height(const Heights& heights, const Array2d<std::uint8_t>& excluded,
                                    const SurfaceFit& surface, int column, int row, double z) {
  double n = 0, sx = 0, sy = 0, sz = 0, sxx = 0, sxy = 0, syy = 0, sxz = 0, syz = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      const int x = column + dx, y = row + dy;
      if (!heights.height_m.contains(x, y) || excluded(x, y) || std::isnan(heights.height_m(x, y))) continue;
      const double above = heights.height_m(x, y) - z,
                   distance_m = std::max(std::abs(dx), std::abs(dy)) * surface.cell_m;
      if (std::abs(above) > surface.scatter_m + kSteepestSurface * distance_m) continue;
      const double sigma = heights.sigma_m(x, y);
      const double w = 1 / (sigma * sigma + surface.scatter_m * surface.scatter_m);
      n += w, sx += w * dx, sy += w * dy, sz += w * above;
      sxx += w * dx * dx, sxy += w * dx * dy, syy += w * dy * dy, sxz += w * dx * above, syz += w * dy * above;
    }
  }
  if (!(n > 0)) return std::nullopt;
  const double mx = sx / n, my = sy / n, mz = sz / n;
  const double xx = sxx / n - mx * mx + kRidge, xy = sxy / n - mx * my, yy = syy / n - my * my + kRidge;
  const double xz = sxz / n - mx * mz, yz = syz / n - my * mz, determinant = xx * yy - xy * xy;
  const double fit = mz - ((xz * yy - yz * xy) * mx + (yz * xx - xz * xy) * my) / determinant;
  if (std::abs(fit) > surface.scatter_m + surface.cell_m) return std::nullopt;
  return z + fit;
}

}  // namespace skysweep::sweep
