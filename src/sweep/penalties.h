// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sweep/cost_volume.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Prices of height steps in the units of the cost volume. Between cells that differ in the guide image by more than
// options.edge_contrast, P2 falls in proportion, to a quarter at the least, and never below P1. Whole numbers: every
// backend pays the same.
class Penalties {
 public:
  explicit Penalties(const SweepProblem& problem)
      : guide_(problem.guide),
        contrast_(static_cast<int>(std::lround(problem.options.edge_contrast))),
        small_(units(problem.options.small_step_penalty)),
        large_(units(problem.options.large_step_penalty)) {}

  int small() const { return small_; }                                         // P1
  int large() const { return large_; }                                         // P2 away from edges
  int contrast() const { return contrast_; }                                   // grey levels; 0: no edges
  int large(int from_column, int from_row, int to_column, int to_row) const {  // P2
    if (guide_.empty() || contrast_ == 0) return large_;
    const int from = guide_(from_column, from_row), to = guide_(to_column, to_row);
    const int difference = std::min(std::abs(to - from), 4 * contrast_);
    if (from == 0 || to == 0 || difference <= contrast_) return large_;
    return std::max(small_, large_ / difference * contrast_);
  }

 private:
  static int units(double grey_levels) { return static_cast<int>(std::lround(grey_levels * kCostScale)); }

  const Array2d<std::uint8_t>& guide_;
  int contrast_, small_, large_;
};

}  // namespace skysweep::sweep
