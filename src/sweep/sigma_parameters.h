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
inline constexpr SigmaOfDoubtless kSigmaOfDoubtless = {-0.68, 0.44, 0.19, -0.14, -0.35, -0.8};

// Below which ln excess they do not.
struct Doubt {
  double level, cost, undecided;
};
inline constexpr Doubt kDoubt = {0.6, 2.8, 0.85};

// ln (sigma / step) where they do not.
struct SigmaOfDoubtful {
  double level, cost, undecided;
};
inline constexpr SigmaOfDoubtful kSigmaOfDoubtful = {-0.7, 0.6, -0.5};

}  // namespace skysweep::sweep
