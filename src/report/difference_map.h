// SPDX-License-Identifier: Apache-2.0
// A picture of where a surface is too high and where too low, with its legend.
#pragma once

#include "core/array2d.h"
#include "core/color.h"
#include "report/height_differences.h"

namespace skysweep::report {

struct DifferenceMapOptions {
  double limit_m = 0;       // > 0: dz of this size and beyond has the end colours
  int largest_side_px = 0;  // > 0: larger maps are thinned, each pixel the mean of the known cells below it
};

// Blue where the surface is too low, near white where it is right, red where it is too high, linear in dz up to the
// limits; hatched where there is a true height but no measured one; dark grey where there is no true one. Small maps
// are magnified by a whole number. The legend below states the limits in metres.
Array2d<Rgb8> difference_map(const HeightDifferences& cells, const DifferenceMapOptions& options);

// Colour of a dz in units of the limit.
Rgb8 difference_color(double dz_in_limits);

}  // namespace skysweep::report
