// SPDX-License-Identifier: Apache-2.0
#include "report/ortho_lattice.h"

#include <cmath>

#include "core/error.h"
#include "raster/crs.h"

namespace skysweep::report {

CellOffset lattice_offset(const raster::GeoReference& ortho, const raster::GeoReference& truth) {
  if (!raster::same_crs(ortho.crs_wkt, truth.crs_wkt))
    throw usage_error("the orthophoto is in " + raster::crs_name(ortho.crs_wkt) + " but the true one is in " +
                      raster::crs_name(truth.crs_wkt) + ": bring both into one system first");
  const Vec2d corners = truth.north_west_corner - ortho.north_west_corner;
  const Vec2d exact{corners.x / truth.cell_m, -corners.y / truth.cell_m};
  const Vec2d whole{std::round(exact.x), std::round(exact.y)};
  constexpr double kTolerance = 1e-3;
  if (std::abs(ortho.cell_m / truth.cell_m - 1) > 1e-9 || norm(exact - whole) > kTolerance)
    throw usage_error("the orthophoto and the true one lie on different grids: make both with the same cell");
  return {static_cast<int>(whole.x), static_cast<int>(whole.y)};
}

}  // namespace skysweep::report
