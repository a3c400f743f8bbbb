// SPDX-License-Identifier: Apache-2.0
#include "report/html_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "height_cells.h"
#include "report/difference_map.h"
#include "report/html/base64.h"
#include "report/html/charts.h"

namespace skysweep::report {
namespace {

// Every figure there is, of a small map with a wall.
Evaluation full_evaluation() {
  const auto truth = [](Vec2d p) { return p.x < 2 ? 10.0f : 2.0f; };
  const auto measured = [](Vec2d p) { return p.x < 2 ? 10.1f : p.y < 0.2 ? kHole : 2.0f; };
  const HeightDifferences cells = make_cells(40, 40, 0.1, truth, measured);
  ClassMap classes{Array2d<std::uint8_t>(40, 40, 2), {"none", "ground", "roof & <b>chimney</b>"}};
  Evaluation e;
  e.heights = accuracy_of(cells, nullptr, {0.05});
  e.distribution = error_distribution(cells.dz, 1600, 0.05, 0.15);
  e.edge_step_m = 1;
  e.edges = e.building_edges = edge_accuracy(cells, 1, 0.05, nullptr);
  e.other_edges = e.edges->scores;
  e.classes = accuracy_by_class(cells, classes, 0.05);
  const std::vector<float> sigma(1600, 0.07f);
  e.sigma = sigma_quality(cells.dz, sigma, 1600, 0.15);
  e.sigma->classes = coverage_by_class(cells.dz, sigma, classes);
  e.registration = Registration{12, 6, 0.25, 0.2, -0.15, 3, 4};
  e.color = ColorError{100, 120, {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}};
  return e;
}

HtmlReport page() { return {"Evaluation of <a> & \"b\"", {{"surface", "/maps/a&b.tif"}}, Array2d<Rgb8>(4, 3)}; }

// Name of the first tag that is closed wrongly or never; empty if all are balanced.
std::string unbalanced_tag(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "unfinished";
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag[0] == '!' || tag.back() == '/') continue;
    const std::string name = tag.substr(tag[0] == '/', tag.find(' ') - (tag[0] == '/'));
    if (tag[0] != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name) return name;
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

TEST(HtmlReport, every_tag_is_closed_and_input_is_escaped) {
  const std::string html = to_html(full_evaluation(), page());
  EXPECT_EQ(unbalanced_tag(html), "");
  EXPECT_NE(html.find("Evaluation of &lt;a&gt; &amp; &quot;b&quot;"), std::string::npos);
  EXPECT_NE(html.find("/maps/a&amp;b.tif"), std::string::npos);
  EXPECT_EQ(html.find("<b>chimney"), std::string::npos);
  EXPECT_EQ(html.find("nan"), std::string::npos);
}

TEST(HtmlReport, it_loads_nothing) {
  std::string html = to_html(full_evaluation(), page());
  // Names of XML namespaces are addresses that nobody visits.
  for (std::size_t at; (at = html.find("xmlns=\"http:")) != std::string::npos;) html.erase(at, 12);
  for (const char* word : {"http", "<script", "<link", "@import", "url("})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
}

TEST(HtmlReport, it_holds_the_figures_and_charts) {
  const std::string html = to_html(full_evaluation(), page());
  for (const char* word : {"Heights", "Edges", "Classes", "Confidence", "Orthophoto", "data:image/png;base64,", "NMAD",
                           "0.250", "6 of 12 blocks", "elsewhere, within 0.1 m", "Sigma against true errors"})
    EXPECT_NE(html.find(word), std::string::npos) << word;
}

TEST(HtmlReport, what_was_not_measured_has_no_section) {
  Evaluation e = full_evaluation();
  e.edges.reset();
  e.building_edges.reset();
  e.other_edges.reset();
  e.classes.clear();
  e.sigma.reset();
  e.registration.reset();
  e.color.reset();
  const std::string html = to_html(e, {"t", {}, {}});
  EXPECT_EQ(unbalanced_tag(html), "");
  for (const char* word : {"Edges", "Classes", "Confidence", "Orthophoto", "<img"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
}

TEST(HtmlReport, the_same_evaluation_gives_the_same_bytes) {
  EXPECT_EQ(to_html(full_evaluation(), page()), to_html(full_evaluation(), page()));
}

TEST(HtmlReport, ticks_have_no_negative_zero) {
  const Chart chart{"t", {"x", -1, 1}, {"y", -0.5, 0.5, false, true}, {}, {}};
  const std::string svg = to_svg(chart);
  EXPECT_EQ(svg.find(">-0<"), std::string::npos);
  EXPECT_EQ(svg.find(">-0 %<"), std::string::npos);
  EXPECT_NE(svg.find(">0 %<"), std::string::npos);
}

TEST(HtmlReport, titles_of_charts_fit_into_them) {
  const Evaluation e = full_evaluation();
  constexpr double kPixelsPerCharacter = 7.3;  // of bold text of 13 pixels, rather more than the mean
  for (const Chart& chart : {histogram_chart(e.distribution), cumulative_chart(e.distribution, 0.05),
                             calibration_chart(*e.sigma), contamination_chart(*e.sigma, 0.05)})
    EXPECT_LT(static_cast<double>(chart.title.size()) * kPixelsPerCharacter, 560 - 68) << chart.title;
}

TEST(HtmlReport, text_for_machines_is_json_with_null_for_unknown) {
  Evaluation e = full_evaluation();
  e.edges->steps = {};
  e.other_edges->front().tolerance_m = 0.1;
  e.edges->steps.median_m = kHole;
  const nlohmann::json json = nlohmann::json::parse(to_json(e));
  EXPECT_TRUE(json.at("edges").at("all").at("step_displacement").at("median_m").is_null());
  EXPECT_EQ(json.at("edges").at("elsewhere").at("scores").at(0).at("tolerance_gsd"), 2);
  EXPECT_EQ(json.at("classes").at(0).at("name"), "roof & <b>chimney</b>");
  EXPECT_EQ(json.at("orthophoto").at("color").at("blue").at("p95_absolute"), 9);
  EXPECT_EQ(json.at("sigma").at("completeness").size(), 2u);
  EXPECT_EQ(json.at("distribution").at("counts").size(), 60u);
}

TEST(Base64, known_answers) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

}  // namespace
}  // namespace skysweep::report
