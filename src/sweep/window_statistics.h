// SPDX-License-Identifier: Apache-2.0
// Means and ranges over the square windows around all cells; windows end at the border of the array.
#pragma once

#include "core/array2d.h"

namespace skysweep::sweep {

// Mean of the values within `radius` columns and rows that are not NaN; NaN where all are.
Array2d<float> window_mean(const Array2d<float>& values, int radius);

// Largest minus smallest of them; NaN where all are NaN.
Array2d<float> window_range(const Array2d<float>& values, int radius);

}  // namespace skysweep::sweep
