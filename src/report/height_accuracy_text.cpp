// SPDX-License-Identifier: Apache-2.0
// Accuracy as a table and as JSON.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "report/height_accuracy.h"

namespace skysweep::report {
namespace {

struct Figure {
  const char* name;
  const char* key;
  double HeightErrors::*metres;
};
constexpr Figure kFigures[] = {
    {"mean dz", "mean", &HeightErrors::mean_m}, {"median dz", "median", &HeightErrors::median_m},
    {"RMSE", "rmse", &HeightErrors::rmse_m},    {"median |dz|", "median_absolute", &HeightErrors::median_absolute_m},
    {"NMAD", "nmad", &HeightErrors::nmad_m},    {"LE68", "le68", &HeightErrors::le68_m},
    {"LE90", "le90", &HeightErrors::le90_m},
};

template <typename... Args>
std::string format(const char* pattern, Args... args) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, pattern, args...);
  return buffer;
}

std::string percent(double share) { return std::isfinite(share) ? format("%.2f %%", 100 * share) : "-"; }

std::string table(const HeightErrors& errors, double gsd_m) {
  std::string out;
  out += format("  %-14s %12lld\n", "reference", static_cast<long long>(errors.reference_count));
  out += format("  %-14s %12lld   %s\n", "with a height", static_cast<long long>(errors.valid_count),
                percent(errors.valid_share()).c_str());
  for (const Figure& figure : kFigures) {
    const double value = errors.*figure.metres;
    if (std::isfinite(value))
      out += format("  %-14s %10.4f m   %8.3f GSD\n", figure.name, value, value / gsd_m);
    else
      out += format("  %-14s %12s\n", figure.name, "-");
  }
  for (std::size_t i = 0; i < kTolerancesGsd.size(); ++i)
    out += format("  within %g GSD   %12s of all, %s of those with a height\n", kTolerancesGsd[i],
                  percent(errors.within_of_all[i]).c_str(), percent(errors.within_of_valid[i]).c_str());
  return out;
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json(const HeightErrors& errors, double gsd_m) {
  nlohmann::ordered_json out;
  out["reference_count"] = errors.reference_count;
  out["valid_count"] = errors.valid_count;
  out["valid_share"] = number(errors.valid_share());
  for (const Figure& figure : kFigures) {
    out[std::string(figure.key) + "_m"] = number(errors.*figure.metres);
    out[std::string(figure.key) + "_gsd"] = number(errors.*figure.metres / gsd_m);
  }
  for (std::size_t i = 0; i < kTolerancesGsd.size(); ++i) {
    const std::string key = format("within_%g_gsd", kTolerancesGsd[i]);
    out[key] = {{"of_all", number(errors.within_of_all[i])}, {"of_valid", number(errors.within_of_valid[i])}};
  }
  return out;
}

}  // namespace

std::string to_text(const HeightAccuracy& accuracy) {
  std::string out = format("Heights (GSD %g m, dz = measured - true)\n", accuracy.gsd_m);
  out += table(accuracy.overall, accuracy.gsd_m);
  if (accuracy.masked) out += "Inside the mask\n" + table(*accuracy.masked, accuracy.gsd_m);
  return out;
}

std::string to_json(const HeightAccuracy& accuracy) {
  nlohmann::ordered_json out;
  out["gsd_m"] = accuracy.gsd_m;
  out["overall"] = json(accuracy.overall, accuracy.gsd_m);
  if (accuracy.masked) out["masked"] = json(*accuracy.masked, accuracy.gsd_m);
  return out.dump(2) + "\n";
}

}  // namespace skysweep::report
