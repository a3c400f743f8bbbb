// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/option_values.h"
#include "core/error.h"
#include "formats/check_points.h"
#include "raster/atomic_file.h"
#include "report/height_accuracy.h"
#include "report/registration.h"

namespace skysweep::app {
namespace {

struct EvaluateOptions {
  std::string dsm;
  std::optional<std::string> truth, points, mask, ortho, truth_ortho, origin, json;
  std::optional<int> min_track;
  std::optional<double> max_error;
  double gsd = 0;
  int mask_min = 1;
};

raster::Raster<std::uint8_t> mask_from(const EvaluateOptions& options) {
  raster::Raster<std::uint8_t> mask = raster::read_class_raster(*options.mask);
  for (std::uint8_t& value : mask.values) value = value >= options.mask_min;
  return mask;
}

report::HeightAccuracy heights(const EvaluateOptions& options) {
  const raster::Raster<float> dsm = raster::read_float_raster(options.dsm);
  const report::AccuracyOptions accuracy{require_positive(options.gsd, "--gsd")};
  if (options.truth) {
    const raster::Raster<float> truth = raster::read_float_raster(*options.truth);
    if (!options.mask) return report::compare_surfaces(dsm, truth, nullptr, accuracy);
    const raster::Raster<std::uint8_t> mask = mask_from(options);
    return report::compare_surfaces(dsm, truth, &mask, accuracy);
  }
  const Vec3d origin = options.origin ? parse_origin(*options.origin) : Vec3d{};
  std::vector<Vec3d> points;
  for (const formats::CheckPoint& point :
       formats::read_check_points(*options.points, {options.min_track, options.max_error}, origin))
    points.push_back(point.position);
  return report::compare_points(dsm, points, accuracy);
}

nlohmann::json number_or_null(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

nlohmann::json registration_json(const report::Registration& r) {
  return {{"blocks", r.blocks},
          {"blocks_used", r.blocks_used},
          {"median_shift_cells", number_or_null(r.median_shift_cells)},
          {"median_shift_x_cells", number_or_null(r.median_shift_x_cells)},
          {"median_shift_y_cells", number_or_null(r.median_shift_y_cells)},
          {"median_color_difference", number_or_null(r.median_color_difference)},
          {"mean_color_difference", number_or_null(r.mean_color_difference)}};
}

void check(const EvaluateOptions& o) {
  if (o.truth.has_value() == o.points.has_value())
    throw usage_error("Give either --truth (a surface) or --points (check points).");
  if (o.mask && !o.truth) throw usage_error("--mask goes with --truth.");
  if (o.ortho.has_value() != o.truth_ortho.has_value()) throw usage_error("--ortho and --truth-ortho go together.");
  if (!o.points && (o.origin || o.min_track || o.max_error))
    throw usage_error("--origin, --min-track and --max-error go with --points.");
}

int evaluate(const EvaluateOptions& options) {
  check(options);
  const report::HeightAccuracy accuracy = heights(options);
  std::fputs(report::to_text(accuracy).c_str(), stdout);
  nlohmann::json json = nlohmann::json::parse(report::to_json(accuracy));
  if (options.ortho) {
    const report::Registration r = report::compare_orthophotos(raster::read_color_raster(*options.ortho),
                                                               raster::read_color_raster(*options.truth_ortho));
    std::printf(
        "orthophoto  median shift %.3f cells (east %+.3f, north %+.3f) over %d of %d blocks; colour differs by %.1f "
        "grey "
        "levels (median)\n",
        r.median_shift_cells, r.median_shift_x_cells, r.median_shift_y_cells, r.blocks_used, r.blocks,
        r.median_color_difference);
    json["orthophoto"] = registration_json(r);
  }
  if (options.json) raster::write_bytes_atomically(*options.json, json.dump(1) + "\n");
  return 0;
}

}  // namespace

void add_evaluate_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command =
      program.add_subcommand("evaluate", "Measure a surface against a true one or against check points.");
  auto o = std::make_shared<EvaluateOptions>();
  command->add_option("--dsm", o->dsm, "Surface to measure")->required();
  command->add_option("--truth", o->truth, "True surface (raster)");
  command->add_option("--points", o->points, "Check points: a CSV with x,y,z or a COLMAP model folder");
  command->add_option("--gsd", o->gsd, "Ground sampling distance of the photographs in metres")->required();
  command->add_option("--mask", o->mask, "Raster on the truth's grid: report the cells inside it, too");
  command->add_option("--mask-min", o->mask_min, "Smallest value of the mask that counts as inside (default 1)");
  command->add_option("--origin", o->origin, "X,Y,Z added to the check points");
  command->add_option("--min-track", o->min_track, "COLMAP points seen by fewer photographs are left out");
  command->add_option("--max-error", o->max_error,
                      "COLMAP points with a larger reprojection error (pixels) are left out");
  command->add_option("--ortho", o->ortho, "Orthophoto to measure");
  command->add_option("--truth-ortho", o->truth_ortho, "True orthophoto");
  command->add_option("--json", o->json, "Also write the figures to this file");
  command->callback([o, &chosen] { chosen = [o] { return evaluate(*o); }; });
}

}  // namespace skysweep::app
