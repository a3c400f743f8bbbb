// SPDX-License-Identifier: Apache-2.0
// The charts of the page of an evaluation.
#pragma once

#include "report/evaluation.h"
#include "report/html/svg_chart.h"

namespace skysweep::report {

Chart histogram_chart(const ErrorDistribution& distribution);
Chart cumulative_chart(const ErrorDistribution& distribution, double gsd_m);

// What sigma promises against what the errors are, tenth by tenth. Needs the deciles.
Chart calibration_chart(const SigmaQuality& sigma);

// Contamination against completeness, as the threshold on sigma grows.
Chart contamination_chart(const SigmaQuality& sigma, double gsd_m);

}  // namespace skysweep::report
