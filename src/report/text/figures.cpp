// SPDX-License-Identifier: Apache-2.0
#include "report/text/figures.h"

#include <cmath>

namespace skysweep::report {

std::string number_text(double value, const char* pattern) {
  return std::isfinite(value) ? format(pattern, value) : "-";
}

std::string percent(double share) { return number_text(100 * share, "%.2f %%"); }

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json errors_json(const HeightErrors& errors, double gsd_m) {
  nlohmann::ordered_json out;
  out["reference_count"] = errors.reference_count;
  out["valid_count"] = errors.valid_count;
  out["valid_share"] = number(errors.valid_share());
  for (const HeightFigure& figure : kHeightFigures) {
    out[std::string(figure.key) + "_m"] = number(errors.*figure.metres);
    out[std::string(figure.key) + "_gsd"] = number(errors.*figure.metres / gsd_m);
  }
  for (std::size_t i = 0; i < kTolerancesGsd.size(); ++i) {
    const std::string key = format("within_%g_gsd", kTolerancesGsd[i]);
    out[key] = {{"of_all", number(errors.within_of_all[i])}, {"of_valid", number(errors.within_of_valid[i])}};
  }
  return out;
}

}  // namespace skysweep::report
