// SPDX-License-Identifier: Apache-2.0
// `evaluate` on small rasters: what each option changes and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "raster/crs.h"
#include "raster/geotiff.h"
#include "raster/temp_folder.h"

namespace skysweep::app_test {
namespace {

using testing_support::file_bytes;
using testing_support::put_bytes;

// A house of 6 m on flat ground, 60 x 40 cells of 0.1 m; in the map it is a cell wider to the east, 0.06 m too high,
// and the two southern rows are missing.
class Evaluate : public testing::Test {
 protected:
  static constexpr int kWidth = 60, kHeight = 40;

  Evaluate() {
    const auto house = [](int x, int y, int east) { return x >= 20 && x < east && y >= 10 && y < 30; };
    write<float>("truth.tif", "height", [&](int x, int y) { return house(x, y, 40) ? 6.f : 0.f; });
    write<float>("dsm.tif", "height", [&](int x, int y) {
      return y >= kHeight - 2 ? std::numeric_limits<float>::quiet_NaN() : house(x, y, 41) ? 6.06f : 0.f;
    });
    write<std::uint8_t>("classes.tif", "surface class: 1 ground, 2 roof",
                        [&](int x, int y) -> std::uint8_t { return house(x, y, 40) ? 2 : 1; });
    write<float>("sigma.tif", "sigma", [&](int x, int y) { return house(x, y, 41) ? 0.1f : 0.02f; });
    write<Rgba8>("ortho.tif", "colour", [](int x, int y) { return texture(x, y, 12); });
    write<Rgba8>("truth_ortho.tif", "colour", [](int x, int y) { return texture(x, y, 0); });
    put_bytes(folder / "points.csv", "x,y,z\n1.05,1.05,0\n3.05,2.05,6\n");
  }

  static Rgba8 texture(int x, int y, int red) {
    return {static_cast<std::uint8_t>(100 + x % 7 + red), static_cast<std::uint8_t>(100 + y % 5), 80, 255};
  }

  template <typename T, typename Value>
  void write(const std::string& name, const std::string& content, Value value) const {
    raster::Raster<T> out{
        Array2d<T>(kWidth, kHeight), {raster::local_metric_crs(), {0, kHeight * 0.1}, 0.1}, {content, "", "", "", ""}};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) out.values(x, y) = value(x, y);
    raster::write_geotiff(folder / name, out);
  }

  std::string path(const std::string& name) const { return (folder / name).string(); }

  Outcome evaluate(const Arguments& more) const {
    Arguments all = {"evaluate", "--dsm", path("dsm.tif"), "--gsd", "0.05"};
    all.insert(all.end(), more.begin(), more.end());
    return skysweep(all);
  }

  // The figures of a comparison with the true surface.
  nlohmann::json figures(const Arguments& more = {}) const {
    Arguments all = {"--truth", path("truth.tif"), "--json", path("figures.json")};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = evaluate(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(file_bytes(folder / "figures.json"));
  }

  // The sentence of a usage error.
  std::string refusal(const Arguments& more) const {
    const Outcome outcome = evaluate(more);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    return outcome.err;
  }

  testing_support::TempFolder folder;
};

TEST_F(Evaluate, edges_and_steps_come_with_a_true_surface) {
  const nlohmann::json edges = figures().at("edges");
  EXPECT_EQ(edges.at("step_m"), 1);
  EXPECT_EQ(edges.at("all").at("scores").at(0).at("tolerance_m"), 0.1);
  EXPECT_EQ(edges.at("all").at("scores").at(0).at("f_score"), 1);
  EXPECT_GT(edges.at("all").at("step_displacement").at("p95_m").get<double>(), 0.08);  // the eastern wall
  EXPECT_FALSE(edges.contains("buildings"));
}

TEST_F(Evaluate, edge_step_leaves_lower_edges_out) {
  EXPECT_EQ(figures({"--edge-step", "5"}).at("edges").at("all").at("scores").at(0).at("true_count"), 80);
  EXPECT_EQ(figures({"--edge-step", "7"}).at("edges").at("all").at("scores").at(0).at("true_count"), 0);
}

TEST_F(Evaluate, classes_are_reported_by_the_names_in_their_raster) {
  const nlohmann::json all = figures({"--classes", path("classes.tif")});
  ASSERT_EQ(all.at("classes").size(), 2u);
  EXPECT_EQ(all.at("classes").at(0).at("name"), "ground");
  EXPECT_EQ(all.at("classes").at(1).at("name"), "roof");
  EXPECT_NEAR(all.at("classes").at(1).at("median_m").get<double>(), 0.06, 1e-5);
  EXPECT_EQ(all.at("edges").at("buildings").at("scores").at(0).at("f_score"), 1);
  EXPECT_EQ(all.at("edges").at("elsewhere").at("scores").at(0).at("measured_count"), 0);
}

TEST_F(Evaluate, sigma_is_compared_with_the_errors) {
  const nlohmann::json sigma = figures({"--sigma", path("sigma.tif"), "--classes", path("classes.tif")}).at("sigma");
  // Off by 6 m: the twenty cells by which the house is too wide, of 60 x 38.
  EXPECT_NEAR(sigma.at("overall").at("within_68").get<double>(), 1 - 20. / 2280, 1e-9);
  EXPECT_EQ(sigma.at("classes").size(), 2u);
  EXPECT_NEAR(sigma.at("outlier_m").get<double>(), 0.15, 1e-9);
  EXPECT_NEAR(sigma.at("completeness").at(0).at("completeness").get<double>(), 2280. / 2400, 1e-9);
}

TEST_F(Evaluate, outlier_gsd_says_what_an_outlier_is) {
  // With an outlier from 0.05 m on, the whole roof is one.
  const nlohmann::json sigma = figures({"--sigma", path("sigma.tif"), "--outlier-gsd", "1"}).at("sigma");
  EXPECT_NEAR(sigma.at("completeness").at(0).at("completeness").get<double>(), (2280. - 420) / 2400, 1e-9);
}

TEST_F(Evaluate, points_can_have_a_sigma_too) {
  const Outcome outcome = evaluate({"--points", path("points.csv"), "--sigma", path("sigma.tif")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Sigma: 100.00 % inside"), std::string::npos) << outcome.out;
}

TEST_F(Evaluate, colours_are_compared_channel_by_channel) {
  const nlohmann::json color =
      figures({"--ortho", path("ortho.tif"), "--truth-ortho", path("truth_ortho.tif")}).at("orthophoto").at("color");
  EXPECT_EQ(color.at("red").at("median"), 12);
  EXPECT_EQ(color.at("green").at("median"), 0);
}

TEST_F(Evaluate, difference_limit_sets_the_histogram_and_the_map) {
  EXPECT_NEAR(figures().at("distribution").at("limit_m").get<double>(), 0.15, 1e-9);
  EXPECT_EQ(figures({"--difference-limit", "2"}).at("distribution").at("limit_m"), 2);
  figures({"--difference", path("narrow.png")});
  figures({"--difference", path("wide.png"), "--difference-limit", "2"});
  EXPECT_EQ(file_bytes(folder / "wide.png").substr(1, 3), "PNG");
  EXPECT_NE(file_bytes(folder / "wide.png"), file_bytes(folder / "narrow.png"));
}

TEST_F(Evaluate, html_writes_one_page_with_the_inputs) {
  figures({"--html", path("page.html"), "--classes", path("classes.tif")});
  const std::string page = file_bytes(folder / "page.html");
  EXPECT_EQ(page.substr(0, 15), "<!DOCTYPE html>");
  for (const char* word : {"dsm.tif", "classes.tif", "data:image/png;base64,", "roof"})
    EXPECT_NE(page.find(word), std::string::npos) << word;
}

TEST_F(Evaluate, combinations_that_make_no_sense_are_refused_with_a_sentence) {
  const std::string truth = path("truth.tif"), points = path("points.csv"), classes = path("classes.tif");
  struct Case {
    Arguments arguments;
    const char* sentence;
  };
  for (const Case& c : std::vector<Case>{
           {{}, "either --truth"},
           {{"--truth", truth, "--points", points}, "either --truth"},
           {{"--points", points, "--mask", classes}, "--mask goes with --truth"},
           {{"--points", points, "--classes", classes}, "--classes goes with --truth"},
           {{"--points", points, "--difference", path("d.png")}, "--difference goes with --truth"},
           {{"--points", points, "--edge-step", "1"}, "--edge-step goes with --truth"},
           {{"--truth", truth, "--outlier-gsd", "2"}, "--outlier-gsd goes with --sigma"},
           {{"--truth", truth, "--ortho", truth}, "go together"},
           {{"--truth", truth, "--min-track", "3"}, "go with --points"},
           {{"--truth", truth, "--edge-step", "0"}, "--edge-step"},
           {{"--truth", truth, "--sigma", path("sigma.tif"), "--outlier-gsd", "-1"}, "--outlier-gsd"},
           {{"--truth", truth, "--difference-limit", "0"}, "--difference-limit"},
           {{"--truth", truth, "--difference", path("d.jpg")}, "end in .png"},
       })
    EXPECT_NE(refusal(c.arguments).find(c.sentence), std::string::npos) << c.sentence;
}

TEST_F(Evaluate, classes_of_another_grid_are_refused) {
  raster::write_geotiff(
      folder / "other.tif",
      raster::Raster<std::uint8_t>{Array2d<std::uint8_t>(3, 3, 1), {raster::local_metric_crs(), {0, 4}, 0.1}, {}});
  EXPECT_NE(refusal({"--truth", path("truth.tif"), "--classes", path("other.tif")}).find("the map of classes"),
            std::string::npos);
}

TEST_F(Evaluate, missing_inputs_are_bad_input) {
  EXPECT_EQ(evaluate({"--truth", path("truth.tif"), "--classes", path("none.tif")}).exit_code, 3);
  EXPECT_EQ(evaluate({"--truth", path("truth.tif"), "--sigma", path("none.tif")}).exit_code, 3);
}

}  // namespace
}  // namespace skysweep::app_test
