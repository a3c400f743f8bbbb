// SPDX-License-Identifier: Apache-2.0
// How the errors of heights are spread, for charts: histogram of dz and cumulative share of |dz|.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace skysweep::report {

struct ErrorDistribution {
  static constexpr std::size_t kBins = 60;
  double limit_m = 0;                        // the histogram covers -limit to +limit
  std::array<std::int64_t, kBins> counts{};  // equal bins by growing dz; +limit belongs to the last
  std::int64_t below = 0, above = 0;         // heights beyond the limits

  struct Share {
    double error_m = 0;
    double of_all = 0;  // share of the reference heights with |dz| of at most this; holes count as misses
  };
  std::vector<Share> cumulative;  // at errors from 0.1 to 100 GSD, equally spaced in their logarithm
};

// `dz` is NaN where there is no height; `reference_count` counts the holes, too.
ErrorDistribution error_distribution(std::span<const float> dz, std::int64_t reference_count, double gsd_m,
                                     double limit_m);

}  // namespace skysweep::report
