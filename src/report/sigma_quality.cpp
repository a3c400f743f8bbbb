// SPDX-License-Identifier: Apache-2.0
#include "report/sigma_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "report/quantile.h"

namespace skysweep::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kDeciles = 10;
constexpr std::size_t kCurvePoints = 200;

// One height with an error and a sigma.
struct Sample {
  float error_m;  // |dz|
  float sigma_m;
};

bool is_known(float dz, float sigma_m) { return std::isfinite(dz) && std::isfinite(sigma_m) && sigma_m >= 0; }

Coverage coverage_of(std::span<const Sample> samples) {
  Coverage out;
  out.count = static_cast<std::int64_t>(samples.size());
  std::int64_t within_68 = 0, within_95 = 0;
  std::vector<float> errors, sigmas;
  errors.reserve(samples.size());
  sigmas.reserve(samples.size());
  for (const Sample& s : samples) {
    within_68 += s.error_m <= kInterval68 * s.sigma_m;
    within_95 += s.error_m <= kInterval95 * s.sigma_m;
    errors.push_back(s.error_m);
    sigmas.push_back(s.sigma_m);
  }
  const auto count = static_cast<double>(samples.size());
  out.within_68 = samples.empty() ? kNaN : static_cast<double>(within_68) / count;
  out.within_95 = samples.empty() ? kNaN : static_cast<double>(within_95) / count;
  out.median_sigma_m = quantile(sigmas, 0.5);
  out.le68_m = quantile(errors, 0.683);
  return out;
}

// Thresholds by growing sigma. Heights of equal sigma are kept or left out together. `samples` are sorted by sigma.
std::vector<SigmaThreshold> thresholds(const std::vector<Sample>& samples, std::int64_t reference_count,
                                       double outlier_m) {
  std::vector<SigmaThreshold> out;
  std::int64_t outliers = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    outliers += samples[i].error_m > outlier_m;
    if (i + 1 < samples.size() && samples[i + 1].sigma_m == samples[i].sigma_m) continue;
    const auto kept = static_cast<double>(i + 1);
    out.push_back(
        {samples[i].sigma_m, kept / static_cast<double>(reference_count), static_cast<double>(outliers) / kept});
  }
  return out;
}

// Every n-th of the thresholds, always with the last.
std::vector<SigmaThreshold> thinned(const std::vector<SigmaThreshold>& all) {
  std::vector<SigmaThreshold> out;
  const std::size_t count = std::min(all.size(), kCurvePoints);
  for (std::size_t i = 0; i < count; ++i) out.push_back(all[(i + 1) * all.size() / count - 1]);
  return out;
}

CompletenessLimit best_within(const std::vector<SigmaThreshold>& all, double allowed) {
  CompletenessLimit out{allowed, {kNaN, 0, kNaN}};
  for (const SigmaThreshold& threshold : all)
    if (threshold.contamination <= allowed) out.best = threshold;  // completeness grows along the list
  return out;
}

}  // namespace

SigmaQuality sigma_quality(std::span<const float> dz, std::span<const float> sigma_m, std::int64_t reference_count,
                           double outlier_m) {
  SKY_CHECK_EQ(dz.size(), sigma_m.size());
  SigmaQuality out;
  out.outlier_m = outlier_m;
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < dz.size(); ++i) {
    if (is_known(dz[i], sigma_m[i]))
      samples.push_back({std::abs(dz[i]), sigma_m[i]});
    else if (std::isfinite(dz[i]))
      ++out.without_sigma;
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.sigma_m != b.sigma_m ? a.sigma_m < b.sigma_m : a.error_m < b.error_m;
  });
  out.overall = coverage_of(samples);
  if (samples.size() >= kDeciles)
    for (std::size_t i = 0; i < kDeciles; ++i) {
      const std::size_t first = i * samples.size() / kDeciles, last = (i + 1) * samples.size() / kDeciles;
      out.deciles.push_back(coverage_of(std::span(samples).subspan(first, last - first)));
    }
  const std::vector<SigmaThreshold> all = thresholds(samples, reference_count, outlier_m);
  for (std::size_t i = 0; i < out.limits.size(); ++i) out.limits[i] = best_within(all, kAllowedContaminations[i]);
  out.curve = thinned(all);
  return out;
}

std::vector<ClassCoverage> coverage_by_class(std::span<const float> dz, std::span<const float> sigma_m,
                                             const ClassMap& classes) {
  SKY_CHECK_EQ(dz.size(), sigma_m.size());
  SKY_CHECK_EQ(dz.size(), classes.codes.size());
  std::array<std::vector<Sample>, 256> samples;
  for (std::size_t i = 0; i < dz.size(); ++i)
    if (is_known(dz[i], sigma_m[i])) samples[classes.codes.data()[i]].push_back({std::abs(dz[i]), sigma_m[i]});
  std::vector<ClassCoverage> out;
  for (int code = 0; code < 256; ++code)
    if (!samples[code].empty()) out.push_back({code, classes.name(code), coverage_of(samples[code])});
  return out;
}

}  // namespace skysweep::report
