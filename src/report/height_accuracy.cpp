// SPDX-License-Identifier: Apache-2.0
#include "report/height_accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "raster/crs.h"
#include "report/quantile.h"

namespace skysweep::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double share(double count, double all) { return all > 0 ? count / all : kNaN; }

// Figures of the errors of all measured heights; single precision is plenty for differences and halves the memory.
HeightErrors summarise(std::vector<float> dz, std::int64_t reference_count, double gsd_m) {
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

// Reads heights of a surface anywhere.
class Surface {
 public:
  explicit Surface(const raster::Raster<float>& dsm) : dsm_(dsm) {}

  // NaN outside and beside holes.
  double at(Vec2d p) const {
    const raster::GeoReference& g = dsm_.georeference;
    const double x = (p.x - g.north_west_corner.x) / g.cell_m - 0.5;
    const double y = (g.north_west_corner.y - p.y) / g.cell_m - 0.5;
    const Axis column = split(x, dsm_.values.width()), row = split(y, dsm_.values.height());
    if (!column.inside || !row.inside) return kNaN;
    const auto value = [&](int c, int r) -> double { return dsm_.values(c, r); };
    const double north = mix(value(column.index, row.index), value(column.next, row.index), column.fraction);
    const double south = mix(value(column.index, row.next), value(column.next, row.next), column.fraction);
    return mix(north, south, row.fraction);
  }

 private:
  struct Axis {
    bool inside = false;
    int index = 0, next = 0;
    double fraction = 0;
  };
  static double mix(double a, double b, double t) { return (1 - t) * a + t * b; }

  static Axis split(double position, int count) {
    // A position on a cell centre up to rounding (coordinates of UTM size) must not ask for a neighbour.
    constexpr double kOnCentre = 1e-6;
    if (const double nearest = std::round(position); std::abs(position - nearest) < kOnCentre) position = nearest;
    if (!(position >= 0 && position <= count - 1)) return {};
    const int index = static_cast<int>(position);
    const double fraction = position - index;
    return {true, index, fraction > 0 ? index + 1 : index, fraction};
  }

  const raster::Raster<float>& dsm_;
};

void require_gsd(const AccuracyOptions& options) {
  if (!(options.gsd_m > 0 && std::isfinite(options.gsd_m)))
    throw usage_error("the ground sampling distance must be a positive number of metres");
}

void require_same_grid(const raster::Raster<std::uint8_t>& mask, const raster::Raster<float>& truth) {
  const Vec2d shift = mask.georeference.north_west_corner - truth.georeference.north_west_corner;
  const double tolerance_m = 1e-3 * truth.georeference.cell_m;
  const bool same_cells = mask.values.width() == truth.values.width() && mask.values.height() == truth.values.height();
  const bool same_place =
      norm(shift) <= tolerance_m &&
      std::abs(mask.georeference.cell_m - truth.georeference.cell_m) * mask.values.width() <= tolerance_m;
  if (!same_cells || !same_place)
    throw usage_error("the mask does not lie on the grid of the true surface: give it the same corner, cell and size");
}

}  // namespace

double HeightErrors::valid_share() const {
  return share(static_cast<double>(valid_count), static_cast<double>(reference_count));
}

HeightAccuracy compare_surfaces(const raster::Raster<float>& dsm, const raster::Raster<float>& truth,
                                const raster::Raster<std::uint8_t>* mask, const AccuracyOptions& options) {
  require_gsd(options);
  if (!raster::same_crs(dsm.georeference.crs_wkt, truth.georeference.crs_wkt))
    throw usage_error("the surface is in " + raster::crs_name(dsm.georeference.crs_wkt) + " but the truth is in " +
                      raster::crs_name(truth.georeference.crs_wkt) + ": bring both into one system first");
  if (mask) require_same_grid(*mask, truth);

  // On one lattice the interpolation falls on cell centres, which needs no neighbours: cell by cell.
  const Surface surface(dsm);
  std::vector<float> all, inside;
  std::int64_t all_count = 0, inside_count = 0;
  for (int row = 0; row < truth.values.height(); ++row) {
    for (int column = 0; column < truth.values.width(); ++column) {
      const float true_height = truth.values(column, row);
      if (!std::isfinite(true_height)) continue;
      const bool in_mask = mask && mask->values(column, row) > 0;
      ++all_count;
      inside_count += in_mask;
      const double height = surface.at(truth.georeference.cell_center(column, row));
      if (!std::isfinite(height)) continue;
      const auto dz = static_cast<float>(height - true_height);
      all.push_back(dz);
      if (in_mask) inside.push_back(dz);
    }
  }
  HeightAccuracy out{options.gsd_m, summarise(std::move(all), all_count, options.gsd_m), std::nullopt};
  if (mask) out.masked = summarise(std::move(inside), inside_count, options.gsd_m);
  return out;
}

HeightAccuracy compare_points(const raster::Raster<float>& dsm, const std::vector<Vec3d>& points,
                              const AccuracyOptions& options) {
  require_gsd(options);
  const Surface surface(dsm);
  std::vector<float> errors;
  for (const Vec3d& p : points) {
    const double height = surface.at({p.x, p.y});
    if (std::isfinite(height)) errors.push_back(static_cast<float>(height - p.z));
  }
  return {options.gsd_m, summarise(std::move(errors), static_cast<std::int64_t>(points.size()), options.gsd_m),
          std::nullopt};
}

}  // namespace skysweep::report
