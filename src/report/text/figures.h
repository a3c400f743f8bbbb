// SPDX-License-Identifier: Apache-2.0
// How figures are written: shared by the tables, the JSON and the page.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "report/height_accuracy.h"

namespace skysweep::report {

// A figure of a length, with its name for people and its key for machines (without the unit).
struct HeightFigure {
  const char* name;
  const char* key;
  double HeightErrors::*metres;
};
inline constexpr HeightFigure kHeightFigures[] = {
    {"mean dz", "mean", &HeightErrors::mean_m}, {"median dz", "median", &HeightErrors::median_m},
    {"RMSE", "rmse", &HeightErrors::rmse_m},    {"median |dz|", "median_absolute", &HeightErrors::median_absolute_m},
    {"NMAD", "nmad", &HeightErrors::nmad_m},    {"LE68", "le68", &HeightErrors::le68_m},
    {"LE90", "le90", &HeightErrors::le90_m},
};

template <typename... Args>
std::string format(const char* pattern, Args... args) {
  char buffer[240];
  std::snprintf(buffer, sizeof buffer, pattern, args...);
  return buffer;
}

// "-" where not finite.
std::string number_text(double value, const char* pattern);
std::string percent(double share);  // "12.34 %"

// null where not finite.
nlohmann::ordered_json number(double value);
nlohmann::ordered_json errors_json(const HeightErrors& errors, double gsd_m);

}  // namespace skysweep::report
