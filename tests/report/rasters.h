// SPDX-License-Identifier: Apache-2.0
// Small rasters with analytic contents for the tests of report.
#pragma once

#include <cstdint>
#include <limits>

#include "raster/crs.h"
#include "raster/geotiff.h"

namespace skysweep::report {

inline constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

inline raster::GeoReference at(Vec2d north_west_corner, double cell_m) {
  return {raster::local_metric_crs(), north_west_corner, cell_m};
}

// value(centre of the cell) for every cell.
template <typename T, typename Value>
raster::Raster<T> make_raster(int width, int height, const raster::GeoReference& where, Value value) {
  raster::Raster<T> out{Array2d<T>(width, height), where, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) out.values(column, row) = value(where.cell_center(column, row));
  return out;
}

}  // namespace skysweep::report
