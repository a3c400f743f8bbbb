// SPDX-License-Identifier: Apache-2.0
// Everything that was found out about a surface (and its orthophoto), as one value: printed, written as JSON or shown
// as a page by the functions below and by report/html_report.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/class_accuracy.h"
#include "report/color_error.h"
#include "report/error_distribution.h"
#include "report/height_accuracy.h"
#include "report/height_edges.h"
#include "report/registration.h"
#include "report/sigma_quality.h"
#include "report/step_displacement.h"

namespace skysweep::report {

struct EdgeAccuracy {
  EdgeScores scores{};
  StepDisplacement steps;
};

struct Evaluation {
  HeightAccuracy heights;
  ErrorDistribution distribution;
  double edge_step_m = 0;                      // height of a step that makes an edge
  std::optional<EdgeAccuracy> edges;           // against a true surface
  std::optional<EdgeAccuracy> building_edges;  // and a map of classes with buildings: theirs
  std::optional<EdgeScores> other_edges;       // and those elsewhere: trees, noise
  std::vector<ClassErrors> classes;            // empty without a map of classes
  std::optional<SigmaQuality> sigma;
  std::optional<Registration> registration;
  std::optional<ColorError> color;
};

// All about the edges of a surface; `region` as in compare_edges.
EdgeAccuracy edge_accuracy(const HeightDifferences& cells, double step_m, double gsd_m,
                           const Array2d<std::uint8_t>* region);

// Tables for people; ends with a line break.
std::string to_text(const Evaluation& evaluation);

// For machines; what is not known is null. Holds all of to_json(HeightAccuracy) under the same names.
std::string to_json(const Evaluation& evaluation);

}  // namespace skysweep::report
