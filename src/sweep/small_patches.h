// SPDX-License-Identifier: Apache-2.0
// Patches of a height grid: cells that hang together because neighbours have nearly the same height.
#pragma once

#include <functional>
#include <vector>

#include "core/array2d.h"

namespace skysweep::sweep {

struct PatchCell {
  int column = 0, row = 0;
};
using Patch = std::vector<PatchCell>;  // in the order of a flood from its first cell in row order

// Calls `f` for each patch of fewer than `smallest_cells` cells, in row order of their first cells. Neighbours (4) are
// of one patch when their heights differ by at most `agreement_m`; NaN cells belong to none.
void for_each_small_patch(const Array2d<float>& height_m, double agreement_m, int smallest_cells,
                          const std::function<void(const Patch&)>& f);

// The heights of all patches of at least `smallest_cells` cells; the others become NaN.
Array2d<float> without_small_patches(const Array2d<float>& height_m, double agreement_m, int smallest_cells);

}  // namespace skysweep::sweep
