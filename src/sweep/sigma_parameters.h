// SPDX-License-Identifier: Apache-2.0
// The parameters of height_sigma, fitted to scenes with exact truth by
//   scripts/fit_sigma.py
// which prints them and the share of the errors that they cover. Heights in units of the height that is worth a pixel
// (ray_geometry.h), costs in grey levels; docs/algorithm.md, section 7.
#pragma once

namespace skysweep::sweep {

// ln sigma where the costs decide.
struct SigmaOfDoubtless {
  double level, step, offset, excess, bend, cost;
};
inline constexpr SigmaOfDoubtless kSigmaOfDoubtless = {-0.513, 0.447, 0.168, -0.346, -0.478, -0.794};

// No height is better than so many pixels, not fitted: on level ground without noise the signs promise more than the
// fit between planes holds (tests/hard, HardBaseline).
inline constexpr double kBestPixels = 0.07;

// Below which ln excess they do not.
struct Doubt {
  double level, cost, undecided;
};
inline constexpr Doubt kDoubt = {0.866, 2.987, 0.823};

// ln (sigma / step) where they do not.
struct SigmaOfDoubtful {
  double level, cost, undecided;
};
inline constexpr SigmaOfDoubtful kSigmaOfDoubtful = {-1.008, 0.768, 0.41};

}  // namespace skysweep::sweep
