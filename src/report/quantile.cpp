// SPDX-License-Identifier: Apache-2.0
#include "report/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace skysweep::report {

double quantile(std::vector<float>& values, double q) {
  SKY_CHECK(q >= 0 && q <= 1);
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double position = q * static_cast<double>(values.size() - 1);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), lower, values.end());
  const double fraction = position - std::floor(position);
  if (fraction == 0) return *lower;
  const double upper = *std::min_element(lower + 1, values.end());
  return *lower + fraction * (upper - *lower);
}

}  // namespace skysweep::report
