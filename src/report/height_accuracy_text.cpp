// SPDX-License-Identifier: Apache-2.0
// Accuracy as a table and as JSON.
#include <cmath>

#include "report/height_accuracy.h"
#include "report/text/figures.h"

namespace skysweep::report {
namespace {

std::string table(const HeightErrors& errors, double gsd_m) {
  std::string out;
  out += format("  %-14s %12lld\n", "reference", static_cast<long long>(errors.reference_count));
  out += format("  %-14s %12lld   %s\n", "with a height", static_cast<long long>(errors.valid_count),
                percent(errors.valid_share()).c_str());
  for (const HeightFigure& figure : kHeightFigures) {
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
  out["overall"] = errors_json(accuracy.overall, accuracy.gsd_m);
  if (accuracy.masked) out["masked"] = errors_json(*accuracy.masked, accuracy.gsd_m);
  return out.dump(2) + "\n";
}

}  // namespace skysweep::report
