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
inline constexpr SigmaOfDoubtless kSigmaOfDoubtless = {-0.531, 0.414, 0.166, -0.439, -0.411, -1.014};

// No height is better than so many pixels, not fitted: on level ground without noise the signs promise more than the
// fit between planes holds (tests/hard, HardBaseline).
inline constexpr double kBestPixels = 0.07;

// Below which ln excess they do not.
struct Doubt {
  double level, cost, undecided;
};
inline constexpr Doubt kDoubt = {0.632, 3.826, 1.121};

// ln (sigma / step) where they do not.
struct SigmaOfDoubtful {
  double level, cost, undecided;
};
inline constexpr SigmaOfDoubtful kSigmaOfDoubtful = {-0.674, 0.279, 0.28};

// ln sigma of cells that chose between the surfaces of a step (edge_evidence.h).
struct SigmaOfEdges {
  double level, difference, margin;
};
inline constexpr SigmaOfEdges kSigmaOfEdges = {-0.224, -0.151, -0.315};

// Below which margin the choice may be wrong, where ln excess is small, too.
struct EdgeDoubt {
  double level, difference, undecided, excess;
};
inline constexpr EdgeDoubt kEdgeDoubt = {0.639, 3.901, -1.186, 1.963};

// ln (sigma / step) of those.
inline constexpr double kEdgeStep = -0.526;

}  // namespace skysweep::sweep
