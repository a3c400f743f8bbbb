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
inline constexpr SigmaOfDoubtless kSigmaOfDoubtless = {-0.533, 0.415, 0.165, -0.433, -0.409, -1.021};

// No height is better than so many pixels, not fitted: on level ground without noise the signs promise more than the
// fit between planes holds (tests/hard, HardBaseline).
inline constexpr double kBestPixels = 0.07;

// Below which ln excess they do not.
struct Doubt {
  double level, cost, undecided;
};
inline constexpr Doubt kDoubt = {0.66, 3.787, 0.896};

// ln (sigma / step) where they do not.
struct SigmaOfDoubtful {
  double level, cost, undecided;
};
inline constexpr SigmaOfDoubtful kSigmaOfDoubtful = {-0.774, 0.369, 0.349};

// ln sigma of cells that chose between the surfaces of a step (edge_evidence.h).
struct SigmaOfEdges {
  double level, difference, margin;
};
inline constexpr SigmaOfEdges kSigmaOfEdges = {-0.218, -0.313, -0.31};

// Below which margin the choice may be wrong, where ln excess is small, too.
struct EdgeDoubt {
  double level, difference, undecided, excess;
};
inline constexpr EdgeDoubt kEdgeDoubt = {0.481, 3.148, -0.55, 1.954};

// ln (sigma / step) of those.
inline constexpr double kEdgeStep = -0.549;

}  // namespace skysweep::sweep
