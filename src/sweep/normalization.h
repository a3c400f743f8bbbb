// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skysweep::sweep {

// How the luminance of photographs is normalised: see SweepOptions::normalization_radius_px (0: as photographed) and
// normalization_tolerance.
struct Normalization {
  int radius_px = 0;
  int tolerance = 0;
};

}  // namespace skysweep::sweep
