// SPDX-License-Identifier: Apache-2.0
// An evaluation for machines. docs/evaluation.md lists the keys.
#include "report/evaluation.h"
#include "report/text/figures.h"

namespace skysweep::report {
namespace {

using Json = nlohmann::ordered_json;

void put_length(Json& out, const std::string& key, double metres, double gsd_m) {
  out[key + "_m"] = number(metres);
  out[key + "_gsd"] = number(metres / gsd_m);
}

Json score_json(const EdgeScore& score, double gsd_m) {
  Json out;
  put_length(out, "tolerance", score.tolerance_m, gsd_m);
  out.update({{"true_count", score.true_count},
              {"true_found", score.true_found},
              {"measured_count", score.measured_count},
              {"measured_right", score.measured_right},
              {"precision", number(score.precision())},
              {"recall", number(score.recall())},
              {"f_score", number(score.f_score())}});
  return out;
}

Json scores_json(const EdgeScores& scores, double gsd_m) {
  Json out = Json::array();
  for (const EdgeScore& score : scores) out.push_back(score_json(score, gsd_m));
  return out;
}

Json edges_json(const EdgeAccuracy& edges, double gsd_m) {
  Json out;
  out["scores"] = scores_json(edges.scores, gsd_m);
  const StepDisplacement& steps = edges.steps;
  Json& displacement = out["step_displacement"];
  displacement["steps"] = steps.steps;
  displacement["found"] = steps.found;
  displacement["reach_m"] = number(steps.reach_m);
  put_length(displacement, "median", steps.median_m, gsd_m);
  put_length(displacement, "mean", steps.mean_m, gsd_m);
  put_length(displacement, "median_absolute", steps.median_absolute_m, gsd_m);
  put_length(displacement, "p5", steps.p5_m, gsd_m);
  put_length(displacement, "p95", steps.p95_m, gsd_m);
  return out;
}

Json coverage_json(const Coverage& coverage) {
  return {{"count", coverage.count},
          {"within_68", number(coverage.within_68)},
          {"within_95", number(coverage.within_95)},
          {"median_sigma_m", number(coverage.median_sigma_m)},
          {"le68_m", number(coverage.le68_m)}};
}

Json threshold_json(const SigmaThreshold& threshold) {
  return {{"sigma_m", number(threshold.sigma_m)},
          {"completeness", number(threshold.completeness)},
          {"contamination", number(threshold.contamination)}};
}

Json sigma_json(const SigmaQuality& sigma, double gsd_m) {
  Json out;
  out["without_sigma"] = sigma.without_sigma;
  out["overall"] = coverage_json(sigma.overall);
  for (const Coverage& decile : sigma.deciles) out["deciles"].push_back(coverage_json(decile));
  for (const ClassCoverage& c : sigma.classes) {
    Json entry{{"code", c.code}, {"name", c.name}};
    entry.update(coverage_json(c.coverage));
    out["classes"].push_back(std::move(entry));
  }
  put_length(out, "outlier", sigma.outlier_m, gsd_m);
  for (const CompletenessLimit& limit : sigma.limits) {
    Json entry{{"allowed_contamination", limit.allowed_contamination}};
    entry.update(threshold_json(limit.best));
    out["completeness"].push_back(std::move(entry));
  }
  for (const SigmaThreshold& threshold : sigma.curve) out["curve"].push_back(threshold_json(threshold));
  return out;
}

Json distribution_json(const ErrorDistribution& distribution) {
  Json cumulative = Json::array();
  for (const ErrorDistribution::Share& share : distribution.cumulative)
    cumulative.push_back({{"error_m", share.error_m}, {"of_all", number(share.of_all)}});
  return {{"limit_m", distribution.limit_m},
          {"counts", distribution.counts},
          {"below", distribution.below},
          {"above", distribution.above},
          {"cumulative", std::move(cumulative)}};
}

Json orthophoto_json(const Registration& r) {
  return {{"blocks", r.blocks},
          {"blocks_used", r.blocks_used},
          {"median_shift_cells", number(r.median_shift_cells)},
          {"median_shift_x_cells", number(r.median_shift_x_cells)},
          {"median_shift_y_cells", number(r.median_shift_y_cells)},
          {"median_color_difference", number(r.median_color_difference)},
          {"mean_color_difference", number(r.mean_color_difference)}};
}

Json color_json(const ColorError& color) {
  Json out{{"cells", color.cells}, {"true_cells", color.true_cells}};
  const char* names[] = {"red", "green", "blue"};
  for (std::size_t i = 0; i < color.channels.size(); ++i)
    out[names[i]] = {{"median", number(color.channels[i].median)},
                     {"median_absolute", number(color.channels[i].median_absolute)},
                     {"p95_absolute", number(color.channels[i].p95_absolute)}};
  return out;
}

}  // namespace

std::string to_json(const Evaluation& e) {
  const double gsd_m = e.heights.gsd_m;
  Json out = Json::parse(to_json(e.heights));
  out["distribution"] = distribution_json(e.distribution);
  if (e.edges) {
    out["edges"] = {{"step_m", e.edge_step_m}, {"all", edges_json(*e.edges, gsd_m)}};
    if (e.building_edges) out["edges"]["buildings"] = edges_json(*e.building_edges, gsd_m);
    if (e.other_edges) out["edges"]["elsewhere"]["scores"] = scores_json(*e.other_edges, gsd_m);
  }
  for (const ClassErrors& c : e.classes) {
    Json entry{{"code", c.code}, {"name", c.name}};
    entry.update(errors_json(c.errors, gsd_m));
    out["classes"].push_back(std::move(entry));
  }
  if (e.sigma) out["sigma"] = sigma_json(*e.sigma, gsd_m);
  if (e.registration) out["orthophoto"] = orthophoto_json(*e.registration);
  if (e.color) out["orthophoto"]["color"] = color_json(*e.color);
  // Names of classes come from files; what is not UTF-8 in them must not cost the figures.
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace skysweep::report
