// SPDX-License-Identifier: Apache-2.0
// What `evaluate` was asked.
#pragma once

#include <optional>
#include <string>

namespace skysweep::app {

struct EvaluateOptions {
  std::string dsm;
  std::optional<std::string> truth, points, mask, classes, sigma, ortho, truth_ortho, origin;  // inputs
  std::optional<std::string> json, difference, html;                                           // outputs
  std::optional<int> min_track;
  std::optional<double> max_error, edge_step, outlier_gsd, difference_limit;
  double gsd = 0;
  int mask_min = 1;

  // Throws Error(usage) with a sentence about values and combinations that make no sense.
  void check() const;

  double edge_step_m() const { return edge_step.value_or(1); }
  double outlier_m() const { return outlier_gsd.value_or(3) * gsd; }
  double difference_limit_m() const { return difference_limit.value_or(3 * gsd); }
};

}  // namespace skysweep::app
