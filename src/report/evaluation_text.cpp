// SPDX-License-Identifier: Apache-2.0
// The tables of an evaluation for people.
#include <cmath>

#include "report/evaluation.h"
#include "report/text/figures.h"

namespace skysweep::report {
namespace {

std::string scores_text(const EdgeScores& scores) {
  std::string out;
  for (const EdgeScore& score : scores)
    out += format("  within %.3g m   precision %s, recall %s, F %s (%lld measured, %lld true)\n", score.tolerance_m,
                  percent(score.precision()).c_str(), percent(score.recall()).c_str(),
                  number_text(score.f_score(), "%.3f").c_str(), static_cast<long long>(score.measured_count),
                  static_cast<long long>(score.true_count));
  return out;
}

std::string edges_text(const EdgeAccuracy& edges, double gsd_m) {
  std::string out = scores_text(edges.scores);
  const StepDisplacement& steps = edges.steps;
  out += format("  steps          %lld of %lld straight ones found", static_cast<long long>(steps.found),
                static_cast<long long>(steps.steps));
  if (steps.found > 0)
    out += format("; displaced by %+.4f m = %+.3f GSD (median), |.| %.3f GSD", steps.median_m, steps.median_m / gsd_m,
                  steps.median_absolute_m / gsd_m);
  return out + "\n";
}

std::string classes_text(const Evaluation& e) {
  std::string out = "Classes           cells   with height   median dz      NMAD      LE90  within 2 GSD of all\n";
  const double gsd_m = e.heights.gsd_m;
  for (const ClassErrors& c : e.classes)
    out += format("  %-12s %9lld %13s %11s %9s %9s %9s\n", c.name.c_str(),
                  static_cast<long long>(c.errors.reference_count), percent(c.errors.valid_share()).c_str(),
                  number_text(c.errors.median_m / gsd_m, "%+.3f").c_str(),
                  number_text(c.errors.nmad_m / gsd_m, "%.3f").c_str(),
                  number_text(c.errors.le90_m / gsd_m, "%.3f").c_str(), percent(c.errors.within_of_all[1]).c_str());
  return out + "  (median, NMAD, LE90 in GSD)\n";
}

std::string sigma_text(const SigmaQuality& sigma, double gsd_m) {
  std::string out = format("Sigma: %s inside its 68.27 %% interval, %s inside its 95 %% interval\n",
                           percent(sigma.overall.within_68).c_str(), percent(sigma.overall.within_95).c_str());
  for (const CompletenessLimit& limit : sigma.limits) {
    out += format("  at most %g %% off by more than %g GSD: completeness %s", 100 * limit.allowed_contamination,
                  sigma.outlier_m / gsd_m, percent(limit.best.completeness).c_str());
    if (std::isfinite(limit.best.sigma_m)) out += format(" (sigma up to %.4g m)", limit.best.sigma_m);
    out += "\n";
  }
  return out;
}

std::string registration_text(const Registration& r) {
  return format(
      "orthophoto  median shift %.3f cells (east %+.3f, north %+.3f) over %d of %d blocks; colour differs by %.1f grey "
      "levels (median)\n",
      r.median_shift_cells, r.median_shift_x_cells, r.median_shift_y_cells, r.blocks_used, r.blocks,
      r.median_color_difference);
}

std::string color_text(const ColorError& color) {
  std::string out;
  const char* names[] = {"red", "green", "blue"};
  for (std::size_t i = 0; i < color.channels.size(); ++i)
    out += format("  %-6s median %s, |.| median %s, 95 %% %s grey levels\n", names[i],
                  number_text(color.channels[i].median, "%+.0f").c_str(),
                  number_text(color.channels[i].median_absolute, "%.0f").c_str(),
                  number_text(color.channels[i].p95_absolute, "%.0f").c_str());
  return out;
}

}  // namespace

std::string to_text(const Evaluation& e) {
  const double gsd_m = e.heights.gsd_m;
  std::string out = to_text(e.heights);
  if (e.edges) out += format("Edges of more than %g m\n", e.edge_step_m) + edges_text(*e.edges, gsd_m);
  if (e.building_edges) out += "Edges of buildings\n" + edges_text(*e.building_edges, gsd_m);
  if (e.other_edges) out += "Edges elsewhere\n" + scores_text(*e.other_edges);
  if (!e.classes.empty()) out += classes_text(e);
  if (e.sigma) out += sigma_text(*e.sigma, gsd_m);
  if (e.registration) out += registration_text(*e.registration);
  if (e.color) out += color_text(*e.color);
  return out;
}

}  // namespace skysweep::report
