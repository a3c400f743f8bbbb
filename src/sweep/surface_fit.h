// SPDX-License-Identifier: Apache-2.0
// The height that the surface around a cell has in it.
#pragma once

#include <optional>

#include "core/array2d.h"
#include "sweep/heights.h"

namespace skysweep::sweep {

struct SurfaceFit {
  double cell_m = 1;
  double scatter_m = 0;  // heights of one surface differ by no more than this and kSteepestSurface times their distance
};

constexpr double kSteepestSurface = 1.2;  // metres a metre: a roof of 50 degrees

// Weighted least-squares plane through the known heights within four columns and rows that may belong to one surface
// with height `z` at (column, row) and are not `excluded`; its height there. Nothing where there is none of them or the
// plane ends up farther from `z` than the surface scatters.
std::optional<double> fitted_height(const Heights& heights, const Array2d<std::uint8_t>& excluded,
                                    const SurfaceFit& surface, int column, int row, double z);

}  // namespace skysweep::sweep
