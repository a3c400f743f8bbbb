// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/evaluate/comparison.h"
#include "raster/atomic_file.h"
#include "raster/picture.h"
#include "report/difference_map.h"
#include "report/html_report.h"

namespace skysweep::app {
namespace {

void write_page(const EvaluateOptions& options, const Comparison& comparison) {
  report::HtmlReport page{"Evaluation of " + options.dsm, {{"surface", options.dsm}}, {}};
  const auto name = [&](const char* what, const std::optional<std::string>& path) {
    if (path) page.inputs.emplace_back(what, *path);
  };
  name("true surface", options.truth);
  name("check points", options.points);
  name("mask", options.mask);
  name("classes", options.classes);
  name("sigma", options.sigma);
  name("orthophoto", options.ortho);
  name("true orthophoto", options.truth_ortho);
  constexpr int kLargestSidePx = 1200;  // more would make the page heavy without showing more
  if (comparison.cells)
    page.difference_map = report::difference_map(*comparison.cells, {options.difference_limit_m(), kLargestSidePx});
  raster::write_bytes_atomically(*options.html, report::to_html(comparison.evaluation, page));
}

int evaluate(const EvaluateOptions& options) {
  options.check();
  const Comparison comparison = compare(options);
  std::fputs(report::to_text(comparison.evaluation).c_str(), stdout);
  if (options.json) raster::write_bytes_atomically(*options.json, report::to_json(comparison.evaluation));
  if (options.difference)
    raster::write_bytes_atomically(*options.difference, raster::png_bytes(report::difference_map(
                                                            *comparison.cells, {options.difference_limit_m()})));
  if (options.html) write_page(options, comparison);
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
  command->add_option("--classes", o->classes, "Raster of classes on the truth's grid: report each class, too");
  command->add_option("--sigma", o->sigma, "Confidence layer of the surface: report whether it can be believed");
  command->add_option("--outlier-gsd", o->outlier_gsd,
                      "Error in GSD from which a height is an outlier that sigma should have marked (default 3)");
  command->add_option("--edge-step", o->edge_step, "Height of a step, metres, that makes an edge (default 1)");
  command->add_option("--origin", o->origin, "X,Y,Z added to the check points");
  command->add_option("--min-track", o->min_track, "COLMAP points seen by fewer photographs are left out");
  command->add_option("--max-error", o->max_error,
                      "COLMAP points with a larger reprojection error (pixels) are left out");
  command->add_option("--ortho", o->ortho, "Orthophoto to measure");
  command->add_option("--truth-ortho", o->truth_ortho, "True orthophoto");
  command->add_option("--json", o->json, "Also write the figures to this file");
  command->add_option("--html", o->html, "Also write them as a page with charts, one file, to this file");
  command->add_option("--difference", o->difference, "Write a map of the errors with its legend to this PNG file");
  command->add_option("--difference-limit", o->difference_limit,
                      "Error in metres at the ends of the map's colours and the histogram (default 3 GSD)");
  command->callback([o, &chosen] { chosen = [o] { return evaluate(*o); }; });
}

}  // namespace skysweep::app
