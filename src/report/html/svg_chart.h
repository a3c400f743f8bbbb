// SPDX-License-Identifier: Apache-2.0
// Charts as inline SVG: axes with ticks, lines, bars. Text of the page's own font, no scripts, no network.
#pragma once

#include <string>
#include <vector>

#include "core/vec.h"

namespace skysweep::report {

struct Axis {
  std::string label;
  double low = 0, high = 1;  // low < high; both positive if logarithmic
  bool logarithmic = false;
  bool percent = false;  // values are shares, ticks are written as percentages
};

struct Line {
  std::string name;  // in the legend; empty: not listed
  std::string color;
  std::vector<Vec2d> points;  // those that are not finite break the line
  bool dashed = false;
  bool dots = false;  // a dot at every point
};

struct Bar {
  double from = 0, to = 0, height = 0;
  std::string color;
};

struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Bar> bars;
  std::vector<Line> lines;
};

std::string to_svg(const Chart& chart);

// Text inside HTML and SVG, and inside quoted attributes: & < > " are escaped; bytes that XML forbids are left out.
std::string escaped(const std::string& text);

}  // namespace skysweep::report
