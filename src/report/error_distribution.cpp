// SPDX-License-Identifier: Apache-2.0
#include "report/error_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::report {

ErrorDistribution error_distribution(std::span<const float> dz, std::int64_t reference_count, double gsd_m,
                                     double limit_m) {
  ErrorDistribution out;
  out.limit_m = limit_m;
  std::vector<float> absolute;
  for (const float value : dz) {
    if (!std::isfinite(value)) continue;
    absolute.push_back(std::abs(value));
    if (value < -limit_m)
      ++out.below;
    else if (value > limit_m)
      ++out.above;
    else {
      const double bin = std::floor((value + limit_m) / (2 * limit_m) * ErrorDistribution::kBins);
      ++out.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, ErrorDistribution::kBins - 1.0))];
    }
  }
  std::sort(absolute.begin(), absolute.end());
  constexpr int kPointsPerDecade = 20, kDecades = 3;
  for (int i = 0; i <= kPointsPerDecade * kDecades; ++i) {
    const double error_m = gsd_m * std::pow(10.0, -1 + static_cast<double>(i) / kPointsPerDecade);
    const auto within = std::upper_bound(absolute.begin(), absolute.end(), error_m,
                                         [](double limit, float value) { return limit < value; }) -
                        absolute.begin();
    out.cumulative.push_back({error_m, reference_count > 0
                                           ? static_cast<double>(within) / static_cast<double>(reference_count)
                                           : std::numeric_limits<double>::quiet_NaN()});
  }
  return out;
}

}  // namespace skysweep::report
