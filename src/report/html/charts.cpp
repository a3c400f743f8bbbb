// SPDX-License-Identifier: Apache-2.0
#include "report/html/charts.h"

#include <algorithm>
#include <cmath>

#include "report/difference_map.h"
#include "report/text/figures.h"

namespace skysweep::report {
namespace {

constexpr const char* kBlue = "#2b6cb0";
constexpr const char* kGrey = "#666";

std::string hex(Rgb8 c) { return format("#%02x%02x%02x", c.r, c.g, c.b); }

}  // namespace

Chart histogram_chart(const ErrorDistribution& distribution) {
  double total = static_cast<double>(distribution.below + distribution.above);
  for (const std::int64_t count : distribution.counts) total += static_cast<double>(count);
  const double limit = distribution.limit_m;
  const auto share = [&](std::int64_t count) { return total > 0 ? static_cast<double>(count) / total : 0; };
  Chart chart{
      "Errors dz = measured - true", {"dz, metres", -limit, limit}, {"share of heights", 0, 0, false, true}, {}, {}};
  const double width = 2 * limit / ErrorDistribution::kBins;
  for (std::size_t i = 0; i < distribution.counts.size(); ++i) {
    const double from = -limit + static_cast<double>(i) * width;
    const double height = share(distribution.counts[i]);
    // In the colours of the map, a little darker where these are near white.
    const Rgb8 c = difference_color((from + width / 2) / limit);
    const auto darker = [](std::uint8_t v) { return static_cast<std::uint8_t>(v * 0.85); };
    chart.bars.push_back({from, from + width, height, hex({darker(c.r), darker(c.g), darker(c.b)})});
    chart.y.high = std::max(chart.y.high, height);
  }
  chart.y.high = chart.y.high > 0 ? 1.08 * chart.y.high : 1;
  chart.title += format(" (beyond: %s below, %s above)", percent(share(distribution.below)).c_str(),
                        percent(share(distribution.above)).c_str());
  return chart;
}

Chart cumulative_chart(const ErrorDistribution& distribution, double gsd_m) {
  Line line{"", kBlue, {}};
  for (const ErrorDistribution::Share& share : distribution.cumulative)
    line.points.push_back({share.error_m / gsd_m, share.of_all});
  return {"Share of all heights with at most this error (holes are misses)",
          {"|dz|, GSD", 0.1, 100, true},
          {"share of all", 0, 1, false, true},
          {},
          {line}};
}

Chart calibration_chart(const SigmaQuality& sigma) {
  Line measured{"tenths of the heights, by sigma", kBlue, {}, false, true};
  double low = 1e300, high = 0;
  for (const Coverage& decile : sigma.deciles) {
    measured.points.push_back({decile.median_sigma_m, decile.le68_m});
    for (const double value : {decile.median_sigma_m, decile.le68_m})
      if (value > 0) low = std::min(low, value), high = std::max(high, value);
  }
  if (!(low < high)) low = low < 1e300 ? low / 2 : 0.1, high = 4 * low;
  low /= 1.5, high *= 1.5;
  return {"Sigma against true errors",
          {"median sigma of the tenth, metres", low, high, true},
          {"68.3 % of its |dz| at most, metres", low, high, true},
          {},
          {{"where a true sigma would lie", kGrey, {{low, low}, {high, high}}, true}, measured}};
}

Chart contamination_chart(const SigmaQuality& sigma, double gsd_m) {
  Line curve{"", kBlue, {}};
  double high = 2 * kAllowedContaminations.back();
  for (const SigmaThreshold& threshold : sigma.curve) {
    curve.points.push_back({threshold.completeness, threshold.contamination});
    high = std::max(high, 1.1 * threshold.contamination);
  }
  Chart chart{format("Outliers (beyond %g GSD) among what a limit on sigma keeps", sigma.outlier_m / gsd_m),
              {"completeness", 0, 1, false, true},
              {"outliers among the kept", 0, std::min(1.0, high), false, true},
              {},
              {}};
  for (const CompletenessLimit& limit : sigma.limits)
    chart.lines.push_back({format("at most %g %%: %s complete", 100 * limit.allowed_contamination,
                                  percent(limit.best.completeness).c_str()),
                           limit.allowed_contamination == kAllowedContaminations.front() ? "#2f855a" : "#c05621",
                           {{0, limit.allowed_contamination}, {1, limit.allowed_contamination}},
                           true});
  chart.lines.push_back(curve);
  return chart;
}

}  // namespace skysweep::report
