// SPDX-License-Identifier: Apache-2.0
#include "app/commands/evaluate/comparison.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/option_values.h"
#include "core/error.h"
#include "formats/check_points.h"
#include "raster/class_names.h"
#include "raster/crs.h"
#include "report/surface_sampler.h"

namespace skysweep::app {
namespace {

raster::Raster<float> read_sigma(const EvaluateOptions& options, const raster::Raster<float>& dsm) {
  raster::Raster<float> sigma = raster::read_float_raster(*options.sigma);
  if (!raster::same_crs(sigma.georeference.crs_wkt, dsm.georeference.crs_wkt))
    throw usage_error("--sigma is in " + raster::crs_name(sigma.georeference.crs_wkt) + " but the surface is in " +
                      raster::crs_name(dsm.georeference.crs_wkt) + ": give the confidence layer of this surface");
  return sigma;
}

std::optional<Array2d<std::uint8_t>> read_mask(const EvaluateOptions& options, const report::HeightDifferences& cells) {
  if (!options.mask) return std::nullopt;
  raster::Raster<std::uint8_t> mask = raster::read_class_raster(*options.mask);
  report::require_same_grid(mask.georeference, mask.values.width(), mask.values.height(), cells, "the mask");
  for (std::uint8_t& value : mask.values) value = value >= options.mask_min;
  return std::move(mask.values);
}

std::optional<report::ClassMap> read_classes(const EvaluateOptions& options, const report::HeightDifferences& cells) {
  if (!options.classes) return std::nullopt;
  raster::Raster<std::uint8_t> codes = raster::read_class_raster(*options.classes);
  report::require_same_grid(codes.georeference, codes.values.width(), codes.values.height(), cells,
                            "the map of classes");
  return report::ClassMap{std::move(codes.values), raster::read_class_names(*options.classes)};
}

// Edges of all kinds, and of the buildings where the classes tell them.
void compare_edges(const EvaluateOptions& options, const report::HeightDifferences& cells,
                   const std::optional<report::ClassMap>& classes, report::Evaluation& out) {
  out.edge_step_m = options.edge_step_m();
  out.edges = report::edge_accuracy(cells, out.edge_step_m, options.gsd, nullptr);
  if (!classes) return;
  constexpr double kMarginGsd = 10;  // around the buildings: a wall that stands too far out is still theirs
  Array2d<std::uint8_t> region = report::building_region(*classes, kMarginGsd * options.gsd, cells.grid.cell_m);
  if (region.empty()) return;
  out.building_edges = report::edge_accuracy(cells, out.edge_step_m, options.gsd, &region);
  for (std::uint8_t& inside : region) inside = !inside;
  out.other_edges = report::compare_edges(cells, out.edge_step_m, options.gsd, &region);
}

Comparison compare_with_surface(const EvaluateOptions& options) {
  const raster::Raster<float> dsm = raster::read_float_raster(options.dsm);
  Comparison out;
  report::Evaluation& e = out.evaluation;
  const report::HeightDifferences& cells =
      out.cells.emplace(report::height_differences(dsm, raster::read_float_raster(*options.truth)));
  const auto mask = read_mask(options, cells);
  const auto classes = read_classes(options, cells);

  e.heights = report::accuracy_of(cells, mask ? &*mask : nullptr, {options.gsd});
  const std::int64_t reference_count = e.heights.overall.reference_count;
  e.distribution = report::error_distribution(cells.dz, reference_count, options.gsd, options.difference_limit_m());
  compare_edges(options, cells, classes, e);
  if (classes) e.classes = report::accuracy_by_class(cells, *classes, options.gsd);
  if (options.sigma) {
    const Array2d<float> sigma =
        report::sampled_on_grid(read_sigma(options, dsm), cells.grid, cells.truth.width(), cells.truth.height());
    e.sigma = report::sigma_quality(cells.dz, sigma, reference_count, options.outlier_m());
    if (classes) e.sigma->classes = report::coverage_by_class(cells.dz, sigma, *classes);
  }
  return out;
}

Comparison compare_with_points(const EvaluateOptions& options) {
  const raster::Raster<float> dsm = raster::read_float_raster(options.dsm);
  const Vec3d origin = options.origin ? parse_origin(*options.origin) : Vec3d{};
  std::vector<Vec3d> points;
  for (const formats::CheckPoint& point :
       formats::read_check_points(*options.points, {options.min_track, options.max_error}, origin))
    points.push_back(point.position);

  Comparison out;
  report::Evaluation& e = out.evaluation;
  const std::vector<float> dz = report::point_differences(dsm, points);
  const auto reference_count = static_cast<std::int64_t>(points.size());
  e.heights = report::accuracy_of(dz, {options.gsd});
  e.distribution = report::error_distribution(dz, reference_count, options.gsd, options.difference_limit_m());
  if (options.sigma) {
    const raster::Raster<float> raster = read_sigma(options, dsm);
    const report::SurfaceSampler sampler(raster);
    std::vector<float> sigma;
    for (const Vec3d& p : points) sigma.push_back(static_cast<float>(sampler.at({p.x, p.y})));
    e.sigma = report::sigma_quality(dz, sigma, reference_count, options.outlier_m());
  }
  return out;
}

}  // namespace

Comparison compare(const EvaluateOptions& options) {
  Comparison out = options.truth ? compare_with_surface(options) : compare_with_points(options);
  if (options.ortho) {
    const raster::Raster<Rgba8> ortho = raster::read_color_raster(*options.ortho);
    const raster::Raster<Rgba8> truth = raster::read_color_raster(*options.truth_ortho);
    out.evaluation.registration = report::compare_orthophotos(ortho, truth);
    out.evaluation.color = report::color_error(ortho, truth);
  }
  return out;
}

}  // namespace skysweep::app
