// SPDX-License-Identifier: Apache-2.0
// Exposure gains for the classic cost, which compares luminance as photographed.
#pragma once

#include "core/array2d.h"
#include "core/executor.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Whether the search compares absolute luminance, and is to compensate exposure: options.compensate_exposure with
// cost = sad and normalization_radius_px = 0. All other searches bear any exposure as they are.
bool compares_luminance(const SweepOptions& options);

// Sets gain and offset of the problem's views so that they compare as if exposed alike; leaves 1 and 0 where exposures
// do not surely differ (sweep/exposure.h). `height_m`: a surface on cells kCoarseCells as large, of which the views'
// coarse mipmap levels are compared; a rough one, a plane even, will do. Does nothing unless compares_luminance.
//
// A factor on light is one on sRGB bytes plus an offset, beyond the darkest: Y' = s Y + 0.055 255 (s - 1) with s the
// 2.4th root of the factor (IEC 61966-2-1).
void equalize_luminance(const Array2d<float>& height_m, Executor& executor, SweepProblem& problem);

}  // namespace skysweep::sweep
