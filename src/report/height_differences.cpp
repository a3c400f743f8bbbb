// SPDX-License-Identifier: Apache-2.0
#include "report/height_differences.h"

#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "raster/crs.h"
#include "report/surface_sampler.h"

namespace skysweep::report {

HeightDifferences height_differences(const raster::Raster<float>& dsm, const raster::Raster<float>& truth) {
  if (!raster::same_crs(dsm.georeference.crs_wkt, truth.georeference.crs_wkt))
    throw usage_error("the surface is in " + raster::crs_name(dsm.georeference.crs_wkt) + " but the truth is in " +
                      raster::crs_name(truth.georeference.crs_wkt) + ": bring both into one system first");
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const int width = truth.values.width(), height = truth.values.height();
  HeightDifferences out{truth.georeference, truth.values, Array2d<float>(width, height, kUnknown),
                        Array2d<float>(width, height, kUnknown)};
  const SurfaceSampler surface(dsm);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double measured = surface.at(truth.georeference.cell_center(column, row));
      const float true_height = truth.values(column, row);
      if (!std::isfinite(true_height)) out.truth(column, row) = kUnknown;
      if (!std::isfinite(measured)) continue;
      out.measured(column, row) = static_cast<float>(measured);
      if (std::isfinite(true_height)) out.dz(column, row) = static_cast<float>(measured - true_height);
    }
  return out;
}

void require_same_grid(const raster::GeoReference& georeference, int width, int height, const HeightDifferences& truth,
                       const char* what) {
  const Vec2d shift = georeference.north_west_corner - truth.grid.north_west_corner;
  const double tolerance_m = 1e-3 * truth.grid.cell_m;
  const bool same_cells = width == truth.truth.width() && height == truth.truth.height();
  const bool same_place =
      norm(shift) <= tolerance_m && std::abs(georeference.cell_m - truth.grid.cell_m) * width <= tolerance_m;
  if (!same_cells || !same_place)
    throw usage_error(std::string(what) +
                      " does not lie on the grid of the true surface: give it the same corner, cell and size");
}

}  // namespace skysweep::report
