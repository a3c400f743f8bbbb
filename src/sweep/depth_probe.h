// SPDX-License-Identifier: Apache-2.0
// How far the ground is below a camera when nothing is known about it: a plane sweep in the frame of one photograph, at
// low resolution, over all depths that its neighbours' parallax can tell apart. It gives a new project its ground
// sampling distance, and so its cell size, plane step and search range.
#pragma once

#include <optional>
#include <vector>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

struct DepthProbe {
  double median_m = 0;    // vertical distance from the CoP to the surface
  double nearest_m = 0;   // 2nd percentile of the trusted pixels
  double farthest_m = 0;  // 98th percentile
  int pixels = 0;         // trusted pixels of the low-resolution photograph
};

// `reference` looks down (near-vertical); `neighbours` overlap with it, presumably. Cameras in a common local frame.
// Matches by zero-mean normalised cross-correlation of 5 x 5 low-resolution pixels, so that
// exposure differences do not matter. Nothing when too few pixels find a clear match.
std::optional<DepthProbe> probe_depth(const View& reference, const std::vector<View>& neighbours);

}  // namespace skysweep::sweep
