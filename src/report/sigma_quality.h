// SPDX-License-Identifier: Apache-2.0
// Can the confidence layer be believed? Coverage of its intervals, and how complete a map stays when its sigma is used
// to keep outliers out. docs/evaluation.md states the formulas.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "report/class_accuracy.h"

namespace skysweep::report {

// Half widths of the intervals in sigma: a normal error lies inside with probability 0.6827 and 0.95.
inline constexpr double kInterval68 = 1, kInterval95 = 1.959964;

// Shares of true heights inside the intervals around the measured ones; NaN where nothing was counted.
struct Coverage {
  std::int64_t count = 0;  // heights with an error and a sigma
  double within_68 = 0;    // |dz| <= kInterval68 sigma
  double within_95 = 0;    // |dz| <= kInterval95 sigma
  double median_sigma_m = 0;
  double le68_m = 0;  // 68.3 % of |dz| are at most this: what sigma should have been
};

struct ClassCoverage {
  int code = 0;
  std::string name;
  Coverage coverage;
};

// Keeping what has at most this sigma.
struct SigmaThreshold {
  double sigma_m = 0;        // NaN if nothing can be kept
  double completeness = 0;   // kept heights, of all reference heights
  double contamination = 0;  // kept heights that are outliers, of those kept; NaN if nothing can be kept
};

struct CompletenessLimit {
  double allowed_contamination = 0;
  SigmaThreshold best;  // the most complete threshold with at most that contamination; completeness 0 if there is none
};
inline constexpr std::array<double, 2> kAllowedContaminations = {0.01, 0.05};

struct SigmaQuality {
  std::int64_t without_sigma = 0;  // heights with an error, but no sigma: never kept, not covered
  Coverage overall;
  std::vector<Coverage> deciles;  // tenths of the heights by growing sigma; empty below ten heights
  std::vector<ClassCoverage> classes;
  double outlier_m = 0;  // |dz| above this is an outlier
  std::array<CompletenessLimit, kAllowedContaminations.size()> limits{};
  std::vector<SigmaThreshold> curve;  // at up to 200 thresholds of growing completeness, the last keeps all
};

// `dz` and `sigma_m` side by side, NaN where unknown; a sigma of 0 or more is known. `reference_count` is that of the
// true heights, holes included. `classes` is left empty: see coverage_by_class.
SigmaQuality sigma_quality(std::span<const float> dz, std::span<const float> sigma_m, std::int64_t reference_count,
                           double outlier_m);

// Coverage of each class of which some cell has an error and a sigma, by code.
std::vector<ClassCoverage> coverage_by_class(std::span<const float> dz, std::span<const float> sigma_m,
                                             const ClassMap& classes);

}  // namespace skysweep::report
