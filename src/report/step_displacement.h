// SPDX-License-Identifier: Apache-2.0
// By how much the walls of buildings stand too far out or in: signed displacement of straight height steps along their
// normal, to a fraction of a cell. docs/evaluation.md states the formulas.
#pragma once

#include <cstdint>

#include "report/height_differences.h"

namespace skysweep::report {

struct StepDisplacement {
  std::int64_t steps = 0;  // straight, clean true steps
  std::int64_t found = 0;  // of these: with one clean measured step within reach
  double reach_m = 0;      // displacements up to half of this can be found
  // Metres, positive = towards the lower side (the object has grown). NaN where no step was found.
  double median_m = 0;
  double mean_m = 0;
  double median_absolute_m = 0;
  double p5_m = 0, p95_m = 0;  // quantiles
};

// Looks at every true height edge (report/height_edges.h) of more than `step_m`, or at those with one of their two
// cells in `region` (may be null; of the cells' size).
StepDisplacement step_displacement(const HeightDifferences& cells, double step_m, double gsd_m,
                                   const Array2d<std::uint8_t>* region);

}  // namespace skysweep::report
