// SPDX-License-Identifier: Apache-2.0
// The steps of `evaluate` between reading its inputs and writing its results.
#pragma once

#include <optional>

#include "app/commands/evaluate/options.h"
#include "report/evaluation.h"

namespace skysweep::app {

struct Comparison {
  report::Evaluation evaluation;
  std::optional<report::HeightDifferences> cells;  // against a true surface
};

// Of the surface with --truth or --points, whichever was given.
Comparison compare(const EvaluateOptions& options);

}  // namespace skysweep::app
