// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/array2d.h"

namespace skysweep::sweep {

constexpr int kLargestSimilarRadius = 5;  // sums of squares stay within 32 bits

// As normalize_locally, but of the pixels within `radius_px` only those count that differ from the one in the middle by
// at most `tolerance` stored units: what lies beyond an edge does not change what a pixel is normalised to, so that a
// roof's edge does not spread over the ground beside it (after the sigma filter of Lee 1983). Beyond the border the
// pixels at the border are repeated.
void normalize_similar(Array2d<std::uint16_t>& luminance, int radius_px, int tolerance);

}  // namespace skysweep::sweep
