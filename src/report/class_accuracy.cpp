// SPDX-License-Identifier: Apache-2.0
#include "report/class_accuracy.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "report/distance_transform.h"

namespace skysweep::report {
namespace {

bool names_building(const std::string& name) {
  for (const char* word : {"roof", "Roof", "facade", "Facade",
                           "fa\xc3\xa7"
                           "ade",
                           "Fa\xc3\xa7"
                           "ade",
                           "building", "Building"})
    if (name.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace

std::string ClassMap::name(int code) const {
  const auto index = static_cast<std::size_t>(code);
  if (index < names.size() && !names[index].empty()) return names[index];
  return code == 0 ? "none" : "class " + std::to_string(code);
}

std::vector<ClassErrors> accuracy_by_class(const HeightDifferences& cells, const ClassMap& classes, double gsd_m) {
  SKY_CHECK_EQ(classes.codes.size(), cells.truth.size());
  std::array<std::int64_t, 256> reference{};
  std::array<std::vector<float>, 256> dz;
  for (std::size_t i = 0; i < cells.truth.size(); ++i) {
    if (std::isnan(cells.truth.data()[i])) continue;
    const std::uint8_t code = classes.codes.data()[i];
    ++reference[code];
    if (const float value = cells.dz.data()[i]; !std::isnan(value)) dz[code].push_back(value);
  }
  std::vector<ClassErrors> out;
  for (int code = 0; code < 256; ++code)
    if (reference[code] > 0)
      out.push_back({code, classes.name(code), height_errors(std::move(dz[code]), reference[code], gsd_m)});
  return out;
}

Array2d<std::uint8_t> building_region(const ClassMap& classes, double margin_m, double cell_m) {
  std::array<std::uint8_t, 256> is_building{};
  for (int code = 1; code < 256; ++code) is_building[code] = names_building(classes.name(code));
  Array2d<std::uint8_t> region = classes.codes;
  for (std::uint8_t& value : region) value = is_building[value];
  if (std::find(region.begin(), region.end(), 1) == region.end()) return {};
  const Array2d<float> distance = squared_distance_to(region);
  const double limit = margin_m / cell_m * (margin_m / cell_m) * (1 + 1e-6);
  for (std::size_t i = 0; i < region.size(); ++i) region.data()[i] = distance.data()[i] <= limit;
  return region;
}

}  // namespace skysweep::report
