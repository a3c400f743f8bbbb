// SPDX-License-Identifier: Apache-2.0
#include "report/surface_sampler.h"

#include <cmath>
#include <limits>

namespace skysweep::report {
namespace {

struct Axis {
  bool inside = false;
  int index = 0, next = 0;
  double fraction = 0;
};

double mix(double a, double b, double t) { return (1 - t) * a + t * b; }

Axis split(double position, int count) {
  // A position on a cell centre up to rounding (coordinates of UTM size) must not ask for a neighbour.
  constexpr double kOnCentre = 1e-6;
  if (const double nearest = std::round(position); std::abs(position - nearest) < kOnCentre) position = nearest;
  if (!(position >= 0 && position <= count - 1)) return {};
  const int index = static_cast<int>(position);
  const double fraction = position - index;
  return {true, index, fraction > 0 ? index + 1 : index, fraction};
}

}  // namespace

double SurfaceSampler::at(Vec2d p) const {
  const raster::GeoReference& g = surface_.georeference;
  const double x = (p.x - g.north_west_corner.x) / g.cell_m - 0.5;
  const double y = (g.north_west_corner.y - p.y) / g.cell_m - 0.5;
  const Axis column = split(x, surface_.values.width()), row = split(y, surface_.values.height());
  if (!column.inside || !row.inside) return std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](int c, int r) -> double { return surface_.values(c, r); };
  const double north = mix(value(column.index, row.index), value(column.next, row.index), column.fraction);
  const double south = mix(value(column.index, row.next), value(column.next, row.next), column.fraction);
  return mix(north, south, row.fraction);
}

Array2d<float> sampled_on_grid(const raster::Raster<float>& surface, const raster::GeoReference& grid, int width,
                               int height) {
  const SurfaceSampler sampler(surface);
  Array2d<float> out(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      out(column, row) = static_cast<float>(sampler.at(grid.cell_center(column, row)));
  return out;
}

}  // namespace skysweep::report
