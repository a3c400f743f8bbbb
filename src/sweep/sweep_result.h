// SPDX-License-Identifier: Apache-2.0
// What the plane sweep answers, cell by cell on the problem's grid.
#pragma once

#include <cstdint>

#include "core/array2d.h"
#include "core/color.h"

namespace skysweep::sweep {

struct SweepResult {
  Array2d<float> height_m;           // absolute height; NaN where nothing is known
  Array2d<float> sigma_m;            // standard deviation of the height; NaN where there is none
  Array2d<Rgba8> color;              // alpha 0 where no colour is known
  Array2d<std::uint8_t> filled;      // 1 where the height is that of the surroundings (sweep/filling.h)
  Array2d<std::uint8_t> planar;      // 1 where the colour comes from the planar fallback
  Array2d<std::int8_t> color_view;   // position in problem.views of the photograph the colour is from; -1 none
  Array2d<std::uint8_t> view_count;  // views that show the cell at its height
  double samples = 0;                // luminance samples that the search took
};

}  // namespace skysweep::sweep
