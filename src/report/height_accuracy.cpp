// SPDX-License-Identifier: Apache-2.0
#include "report/height_accuracy.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/error.h"
#include "report/quantile.h"
#include "report/surface_sampler.h"

namespace skysweep::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double share(double count, double all) { return all > 0 ? count / all : kNaN; }

void require_gsd(const AccuracyOptions& options) {
  if (!(options.gsd_m > 0 && std::isfinite(options.gsd_m)))
    throw usage_error("the ground sampling distance must be a positive number of metres");
}

}  // namespace

double HeightErrors::valid_share() const {
  return share(static_cast<double>(valid_count), static_cast<double>(reference_count));
}

HeightErrors height_errors(std::vector<float> dz, std::int64_t reference_count, double gsd_m) {
  HeightErrors out;
  out.reference_count = reference_count;
  out.valid_count = static_cast<std::int64_t>(dz.size());
  const auto valid = static_cast<double>(dz.size());
  double sum = 0, sum_of_squares = 0;
  std::array<std::int64_t, kTolerancesGsd.size()> within{};
  for (const float value : dz) {
    const double error = value;
    sum += error;
    sum_of_squares += error * error;
    for (std::size_t i = 0; i < within.size(); ++i) within[i] += std::abs(error) <= kTolerancesGsd[i] * gsd_m;
  }
  for (std::size_t i = 0; i < within.size(); ++i) {
    out.within_of_all[i] = share(static_cast<double>(within[i]), static_cast<double>(reference_count));
    out.within_of_valid[i] = share(static_cast<double>(within[i]), valid);
  }
  out.mean_m = share(sum, valid);
  out.rmse_m = std::sqrt(share(sum_of_squares, valid));
  out.median_m = quantile(dz, 0.5);

  std::vector<float> absolute(dz.size());
  std::transform(dz.begin(), dz.end(), absolute.begin(), [](float v) { return std::abs(v); });
  out.median_absolute_m = quantile(absolute, 0.5);
  out.le68_m = quantile(absolute, 0.683);
  out.le90_m = quantile(absolute, 0.9);
  const auto median = static_cast<float>(out.median_m);
  std::transform(dz.begin(), dz.end(), absolute.begin(), [median](float v) { return std::abs(v - median); });
  out.nmad_m = 1.4826 * quantile(absolute, 0.5);
  return out;
}

HeightAccuracy accuracy_of(const HeightDifferences& cells, const Array2d<std::uint8_t>* mask,
                           const AccuracyOptions& options) {
  require_gsd(options);
  std::vector<float> all, inside;
  std::int64_t all_count = 0, inside_count = 0;
  for (std::size_t i = 0; i < cells.truth.size(); ++i) {
    if (std::isnan(cells.truth.data()[i])) continue;
    const bool in_mask = mask && mask->data()[i] > 0;
    ++all_count;
    inside_count += in_mask;
    const float dz = cells.dz.data()[i];
    if (std::isnan(dz)) continue;
    all.push_back(dz);
    if (in_mask) inside.push_back(dz);
  }
  HeightAccuracy out{options.gsd_m, height_errors(std::move(all), all_count, options.gsd_m), std::nullopt};
  if (mask) out.masked = height_errors(std::move(inside), inside_count, options.gsd_m);
  return out;
}

HeightAccuracy compare_surfaces(const raster::Raster<float>& dsm, const raster::Raster<float>& truth,
                                const raster::Raster<std::uint8_t>* mask, const AccuracyOptions& options) {
  require_gsd(options);
  const HeightDifferences cells = height_differences(dsm, truth);
  if (mask) require_same_grid(mask->georeference, mask->values.width(), mask->values.height(), cells, "the mask");
  return accuracy_of(cells, mask ? &mask->values : nullptr, options);
}

std::vector<float> point_differences(const raster::Raster<float>& dsm, const std::vector<Vec3d>& points) {
  const SurfaceSampler surface(dsm);
  std::vector<float> dz;
  for (const Vec3d& p : points) dz.push_back(static_cast<float>(surface.at({p.x, p.y}) - p.z));
  return dz;
}

HeightAccuracy accuracy_of(const std::vector<float>& point_differences, const AccuracyOptions& options) {
  require_gsd(options);
  std::vector<float> known;
  std::copy_if(point_differences.begin(), point_differences.end(), std::back_inserter(known),
               [](float dz) { return std::isfinite(dz); });
  return {options.gsd_m,
          height_errors(std::move(known), static_cast<std::int64_t>(point_differences.size()), options.gsd_m),
          std::nullopt};
}

HeightAccuracy compare_points(const raster::Raster<float>& dsm, const std::vector<Vec3d>& points,
                              const AccuracyOptions& options) {
  return accuracy_of(point_differences(dsm, points), options);
}

}  // namespace skysweep::report
