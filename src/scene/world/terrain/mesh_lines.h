// SPDX-License-Identifier: Apache-2.0
// Where the lines of a rectangular mesh lie: through every crease, close together where there is much to follow.
#pragma once

#include <vector>

namespace skysweep::scene {

struct FineStretch {
  double low = 0, high = 0, spacing = 0;
};

// Ascending, from low to high; all `creases` between them are among the lines, none is further than `spacing` from the
// next, or than a stretch's own spacing within a stretch.
std::vector<double> mesh_lines(double low, double high, double spacing, std::vector<double> creases,
                               const std::vector<FineStretch>& stretches);

}  // namespace skysweep::scene
