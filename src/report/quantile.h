// SPDX-License-Identifier: Apache-2.0
// Order statistics: what robust figures of accuracy and stretches of contrast are made of.
#pragma once

#include <vector>

namespace skysweep::report {

// The q-quantile (q in [0, 1]) with linear interpolation between order statistics; NaN for no values. Values must not
// be NaN; their order is changed. Linear time.
double quantile(std::vector<float>& values, double q);

}  // namespace skysweep::report
