// SPDX-License-Identifier: Apache-2.0
// An evaluation as one HTML page: tables, charts (inline SVG) and the difference map, all inside the file; it loads
// nothing and runs no script. Well-formed XML as well, and fit for printing.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "report/evaluation.h"

namespace skysweep::report {

struct HtmlReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> inputs;  // what was compared: name and value, e.g. "surface", a path
  Array2d<Rgb8> difference_map;                             // may be empty
};

std::string to_html(const Evaluation& evaluation, const HtmlReport& page);

}  // namespace skysweep::report
