// SPDX-License-Identifier: Apache-2.0
// Luminance freed from exposure and contrast, so that sums of absolute differences compare like a correlation.
#pragma once

#include <cstdint>

#include "core/array2d.h"

namespace skysweep::sweep {

// Y' = 128 + 20 (Y - m) / sqrt(s^2 + 3^2), clamped to 0..255, with mean m and standard deviation s over the window of
// (2 radius + 1)^2 pixels, cut off at the border; 3 grey levels keep noise on bare surfaces from becoming texture. In
// and out in units of 1/kLuminanceScale grey level.
void normalize_locally(Array2d<std::uint16_t>& luminance, int radius_px);

constexpr double kNormalizedMean = 128, kNormalizedDeviation = 20;  // grey levels
constexpr double kNoiseFloor = 3;                                   // grey levels

// A value (stored units, as are mean and variance) with the mean at 128 and the deviation at 20 grey levels, in stored
// units; deviations are never taken for less than noise.
std::uint16_t normalized(double value, double mean, double variance);

}  // namespace skysweep::sweep
