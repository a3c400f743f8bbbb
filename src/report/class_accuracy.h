// SPDX-License-Identifier: Apache-2.0
// Accuracy by what stands on the ground: the same figures of height for every class of a map of classes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "report/height_accuracy.h"

namespace skysweep::report {

// A class of every cell of the truth.
struct ClassMap {
  Array2d<std::uint8_t> codes;     // 0 = none
  std::vector<std::string> names;  // by code; may be short or empty

  std::string name(int code) const;  // "roof", or "class 2" where none is given
};

struct ClassErrors {
  int code = 0;
  std::string name;
  HeightErrors errors;
};

// One entry for each code that has a true height, by code; together they hold every cell once. Shapes must agree.
std::vector<ClassErrors> accuracy_by_class(const HeightDifferences& cells, const ClassMap& classes, double gsd_m);

// 1 on the cells of buildings and within `margin_m` of them (a wall that stands too far out still counts as theirs);
// empty if no class is a roof or a facade by its name, or none of its cells is there.
Array2d<std::uint8_t> building_region(const ClassMap& classes, double margin_m, double cell_m);

}  // namespace skysweep::report
