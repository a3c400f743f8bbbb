// SPDX-License-Identifier: Apache-2.0
#include "report/html_report.h"

#include <cmath>

#include "raster/picture.h"
#include "report/html/base64.h"
#include "report/html/charts.h"
#include "report/text/figures.h"

namespace skysweep::report {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, "DejaVu Sans", Arial, sans-serif; color: #1a202c; max-width: 1180px; margin: 24px auto; padding: 0 20px; }
h1 { font-size: 24px; margin: 0 0 4px; } h2 { font-size: 18px; margin: 28px 0 8px; border-bottom: 1px solid #cbd5e0; }
table { border-collapse: collapse; margin: 8px 0 14px; } caption { text-align: left; color: #4a5568; padding-bottom: 4px; }
th, td { padding: 3px 12px 3px 0; text-align: right; border-bottom: 1px solid #e2e8f0; font-variant-numeric: tabular-nums; }
th:first-child, td:first-child { text-align: left; } th { font-weight: 600; }
table.inputs td { text-align: left; word-break: break-all; }
.charts { display: flex; flex-wrap: wrap; gap: 16px; } .charts svg { width: 100%; max-width: 560px; height: auto; }
svg text { font-size: 12px; fill: #2d3748; } svg .title { font-size: 13px; font-weight: 600; }
svg .grid { stroke: #e2e8f0; stroke-width: 1; } svg .frame { fill: none; stroke: #4a5568; }
svg .legend { paint-order: stroke; stroke: #fff; stroke-width: 3px; }
img { max-width: 100%; height: auto; border: 1px solid #cbd5e0; image-rendering: auto; }
p.note { color: #4a5568; margin: 4px 0 12px; }
@media print { body { max-width: none; margin: 0; padding: 0; font-size: 11px; } svg, img, table { break-inside: avoid; }
  h2 { break-after: avoid; } .charts svg { max-width: 48%; } img { max-height: 20cm; } * { print-color-adjust: exact; } }
)";

std::string row(const std::vector<std::string>& cells, const char* kind = "td") {
  std::string out = "<tr>";
  for (const std::string& cell : cells) out += format("<%s>", kind) + escaped(cell) + format("</%s>", kind);
  return out + "</tr>\n";
}

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                  const std::string& caption = "") {
  std::string out = "<table>\n";
  if (!caption.empty()) out += "<caption>" + escaped(caption) + "</caption>\n";
  out += "<thead>" + row(head, "th") + "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& cells : rows) out += row(cells);
  return out + "</tbody>\n</table>\n";
}

std::string section(const std::string& title, const std::string& body) {
  return "<section>\n<h2>" + escaped(title) + "</h2>\n" + body + "</section>\n";
}

std::string note(const std::string& text) { return "<p class=\"note\">" + escaped(text) + "</p>\n"; }
std::string count_text(std::int64_t count) { return std::to_string(count); }

std::string inputs(const HtmlReport& page, double gsd_m) {
  std::string out = "<table class=\"inputs\">\n<tbody>\n";
  for (const auto& [name, value] : page.inputs) out += row({name, value});
  return out + row({"GSD of the photographs", format("%g m", gsd_m)}) + "</tbody>\n</table>\n";
}

std::string heights(const HeightAccuracy& accuracy) {
  std::vector<const HeightErrors*> columns = {&accuracy.overall};
  std::vector<std::string> head = {"", "all, m", "all, GSD"};
  if (accuracy.masked) {
    columns.push_back(&*accuracy.masked);
    head.insert(head.end(), {"inside the mask, m", "inside the mask, GSD"});
  }
  std::vector<std::vector<std::string>> rows;
  for (const HeightFigure& figure : kHeightFigures) {
    rows.push_back({figure.name});
    for (const HeightErrors* errors : columns) {
      rows.back().push_back(number_text(errors->*figure.metres, "%.4f"));
      rows.back().push_back(number_text(errors->*figure.metres / accuracy.gsd_m, "%.3f"));
    }
  }
  std::vector<std::string> share_head = {"", "all"};
  if (accuracy.masked) share_head.push_back("inside the mask");
  std::vector<std::vector<std::string>> shares = {{"true heights"}, {"with a measured height"}};
  for (const HeightErrors* errors : columns) {
    shares[0].push_back(count_text(errors->reference_count));
    shares[1].push_back(percent(errors->valid_share()));
  }
  for (std::size_t i = 0; i < kTolerancesGsd.size(); ++i) {
    shares.push_back({format("within %g GSD, of all", kTolerancesGsd[i])});
    for (const HeightErrors* errors : columns) shares.back().push_back(percent(errors->within_of_all[i]));
  }
  return table(share_head, shares) + table(head, rows);
}

void add_scores(const char* where, const EdgeScores& scores, std::vector<std::vector<std::string>>& rows) {
  for (const EdgeScore& s : scores)
    rows.push_back({format("%s, within %.3g m", where, s.tolerance_m), percent(s.precision()), percent(s.recall()),
                    number_text(s.f_score(), "%.3f"), count_text(s.measured_count), count_text(s.true_count)});
}

std::string edges(const Evaluation& e) {
  struct Kind {
    const char* name;
    const EdgeAccuracy* accuracy;
  };
  std::vector<Kind> kinds = {{"all", &*e.edges}};
  if (e.building_edges) kinds.push_back({"buildings", &*e.building_edges});
  const double gsd_m = e.heights.gsd_m;
  std::vector<std::vector<std::string>> scores, steps;
  for (const Kind& kind : kinds) {
    add_scores(kind.name, kind.accuracy->scores, scores);
    const StepDisplacement& d = kind.accuracy->steps;
    const auto gsd = [&](double metres) { return number_text(metres / gsd_m, "%+.3f"); };
    steps.push_back({kind.name, count_text(d.steps), count_text(d.found), number_text(d.median_m, "%+.4f"),
                     gsd(d.median_m), gsd(d.mean_m), number_text(d.median_absolute_m / gsd_m, "%.3f"),
                     gsd(d.p5_m) + " to " + gsd(d.p95_m)});
  }
  if (e.other_edges) add_scores("elsewhere", *e.other_edges, scores);
  return table({"edges", "precision", "recall", "F", "measured", "true"}, scores,
               format("Steps of more than %g m", e.edge_step_m)) +
         table({"steps", "straight", "found", "median, m", "median, GSD", "mean, GSD", "|.| median, GSD",
                "5 to 95 %, GSD"},
               steps, "Displacement of straight steps along their normal; positive = the object has grown");
}

std::string classes(const Evaluation& e) {
  std::vector<std::vector<std::string>> rows;
  const double gsd_m = e.heights.gsd_m;
  for (const ClassErrors& c : e.classes)
    rows.push_back({c.name, count_text(c.errors.reference_count), percent(c.errors.valid_share()),
                    number_text(c.errors.median_m / gsd_m, "%+.3f"), number_text(c.errors.nmad_m / gsd_m, "%.3f"),
                    number_text(c.errors.le68_m / gsd_m, "%.3f"), number_text(c.errors.le90_m / gsd_m, "%.3f"),
                    percent(c.errors.within_of_all[0]), percent(c.errors.within_of_all[1])});
  return table({"class", "cells", "with a height", "median dz", "NMAD", "LE68", "LE90", "within 1 GSD of all",
                "within 2 GSD of all"},
               rows, "Lengths in GSD");
}

std::vector<std::string> coverage_row(const std::string& name, const Coverage& c) {
  return {name,
          count_text(c.count),
          number_text(c.median_sigma_m, "%.4g"),
          number_text(c.le68_m, "%.4g"),
          percent(c.within_68),
          percent(c.within_95)};
}

std::string sigma(const SigmaQuality& s, double gsd_m) {
  std::string out = "<div class=\"charts\">\n";
  if (!s.deciles.empty()) out += to_svg(calibration_chart(s));
  if (!s.curve.empty()) out += to_svg(contamination_chart(s, gsd_m));
  out += "</div>\n";
  std::vector<std::vector<std::string>> limits;
  for (const CompletenessLimit& limit : s.limits)
    limits.push_back({format("at most %g %%", 100 * limit.allowed_contamination), percent(limit.best.completeness),
                      number_text(limit.best.sigma_m, "%.4g")});
  out += table({format("off by more than %g GSD", s.outlier_m / gsd_m), "completeness", "sigma up to, m"}, limits);
  std::vector<std::vector<std::string>> rows = {coverage_row("all", s.overall)};
  for (std::size_t i = 0; i < s.deciles.size(); ++i)
    rows.push_back(coverage_row(format("tenth %d by sigma", static_cast<int>(i + 1)), s.deciles[i]));
  for (const ClassCoverage& c : s.classes) rows.push_back(coverage_row(c.name, c.coverage));
  out += table({"", "heights", "median sigma, m", "68.3 % of |dz|, m", "inside 68.27 %", "inside 95 %"}, rows,
               "Share of true heights inside the intervals that sigma promises");
  if (s.without_sigma > 0) out += note(count_text(s.without_sigma) + " heights have no sigma: they count as not kept.");
  return out;
}

std::string orthophoto(const Evaluation& e) {
  std::string out;
  if (const auto& r = e.registration)
    out += table({"", "median, cells"},
                 {{"length of the shift", number_text(r->median_shift_cells, "%.3f")},
                  {"shift to the east", number_text(r->median_shift_x_cells, "%+.3f")},
                  {"shift to the north", number_text(r->median_shift_y_cells, "%+.3f")}},
                 format("Registration, from %d of %d blocks", r->blocks_used, r->blocks));
  if (e.color) {
    std::vector<std::vector<std::string>> rows;
    const char* names[] = {"red", "green", "blue"};
    for (std::size_t i = 0; i < e.color->channels.size(); ++i) {
      const ChannelError& c = e.color->channels[i];
      rows.push_back({names[i], number_text(c.median, "%+.0f"), number_text(c.median_absolute, "%.0f"),
                      number_text(c.p95_absolute, "%.0f")});
    }
    out += table({"channel", "median", "|.| median", "|.| 95 %"}, rows,
                 "Colour minus true colour, grey levels of the sRGB values; " + count_text(e.color->cells) + " of " +
                     count_text(e.color->true_cells) + " cells have both");
  }
  return out;
}

std::string picture(const Array2d<Rgb8>& map) {
  return format("<img alt=\"difference map\" width=\"%d\" height=\"%d\" src=\"data:image/png;base64,", map.width(),
                map.height()) +
         base64(raster::png_bytes(map)) + "\"/>\n";
}

}  // namespace

std::string to_html(const Evaluation& e, const HtmlReport& page) {
  const double gsd_m = e.heights.gsd_m;
  std::string out =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta "
      "charset=\"utf-8\"/>\n<title>";
  out += escaped(page.title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + escaped(page.title) +
         "</h1>\n" + inputs(page, gsd_m);
  out += section("Heights", heights(e.heights) + "<div class=\"charts\">\n" + to_svg(histogram_chart(e.distribution)) +
                                to_svg(cumulative_chart(e.distribution, gsd_m)) + "</div>\n");
  if (!page.difference_map.empty()) out += section("Where", picture(page.difference_map));
  if (e.edges) out += section("Edges", edges(e));
  if (!e.classes.empty()) out += section("Classes", classes(e));
  if (e.sigma) out += section("Confidence", sigma(*e.sigma, gsd_m));
  if (e.registration || e.color) out += section("Orthophoto", orthophoto(e));
  return out + "</body>\n</html>\n";
}

}  // namespace skysweep::report
