// SPDX-License-Identifier: Apache-2.0
// Measured and true heights side by side, made from formulas.
#pragma once

#include <cmath>

#include "rasters.h"
#include "report/height_differences.h"

namespace skysweep::report {

// true_height and measured_height(centre of the cell, metres) for every cell of a map with its north-west corner at
// (0, height x cell).
template <typename Truth, typename Measured>
HeightDifferences make_cells(int width, int height, double cell_m, Truth true_height, Measured measured_height) {
  const raster::GeoReference where = at({0, height * cell_m}, cell_m);
  return height_differences(make_raster<float>(width, height, where, measured_height),
                            make_raster<float>(width, height, where, true_height));
}

}  // namespace skysweep::report
