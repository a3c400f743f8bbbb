// SPDX-License-Identifier: Apache-2.0
// How well the rays of the views fix a height, before anything is matched.
#pragma once

#include "core/array2d.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Metres: the standard deviation of a height intersected from the views that show it, if each measures its image
// position with a standard deviation of one pixel: mean GSD / sqrt(sum |t_i - mean t|^2), t_i the horizontal way of the
// ray to view i for each metre up (least squares with the position free), GSD that on level ground along the ray. Of
// each block of kBlockCells x kBlockCells cells, at its centre and the median of its known heights; NaN where a block
// has no height or fewer than two views show it.
Array2d<double> height_per_pixel(const SweepProblem& problem, const Array2d<float>& height_m);

}  // namespace skysweep::sweep
