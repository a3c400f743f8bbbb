// SPDX-License-Identifier: Apache-2.0
#include "report/height_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/random.h"
#include "rasters.h"

namespace skysweep::report {
namespace {

using raster::Raster;

double hills(Vec2d p) { return 100 + 3 * std::sin(p.x / 5) + 2 * std::cos(p.y / 7); }
double slope(Vec2d p) { return 12 + 0.25 * p.x - 0.5 * p.y; }

TEST(HeightAccuracy, a_known_offset_is_the_bias_and_nothing_scatters) {
  const auto truth = make_raster<float>(40, 30, at({0, 15}, 0.5), hills);
  const auto dsm = make_raster<float>(40, 30, at({0, 15}, 0.5), [](Vec2d p) { return hills(p) + 0.25; });
  const HeightErrors e = compare_surfaces(dsm, truth, nullptr, {0.1}).overall;
  EXPECT_EQ(e.reference_count, 1200);
  EXPECT_EQ(e.valid_count, 1200);
  for (const double figure : {e.mean_m, e.median_m, e.rmse_m, e.median_absolute_m, e.le68_m, e.le90_m})
    EXPECT_NEAR(figure, 0.25, 1e-5);
  EXPECT_NEAR(e.nmad_m, 0, 2e-5);
  EXPECT_EQ(e.within_of_all, (std::array<double, 4>{0, 0, 1, 1}));
}

TEST(HeightAccuracy, a_tilt_gives_the_moments_of_a_uniform_distribution) {
  const auto truth = make_raster<float>(1000, 4, at({-50, 0.4}, 0.1), [](Vec2d) { return 0.; });
  const auto dsm = make_raster<float>(1000, 4, at({-50, 0.4}, 0.1), [](Vec2d p) { return p.x / 50; });  // -1 to 1
  const HeightErrors e = compare_surfaces(dsm, truth, nullptr, {1}).overall;
  EXPECT_NEAR(e.mean_m, 0, 1e-6);
  EXPECT_NEAR(e.rmse_m, 1 / std::sqrt(3.), 1e-3);
  EXPECT_NEAR(e.median_absolute_m, 0.5, 2e-3);
  EXPECT_NEAR(e.le90_m, 0.9, 2e-3);
}

TEST(HeightAccuracy, nmad_of_a_gaussian_is_sigma_and_outliers_move_only_the_rmse) {
  Random random(7);
  const auto truth = make_raster<float>(300, 300, at({0, 300}, 1), hills);
  auto dsm = make_raster<float>(300, 300, at({0, 300}, 1), [&](Vec2d p) { return hills(p) + 0.2 * random.normal(); });
  const HeightErrors clean = compare_surfaces(dsm, truth, nullptr, {0.1}).overall;
  EXPECT_NEAR(clean.nmad_m, 0.2, 0.002);
  EXPECT_NEAR(clean.rmse_m, 0.2, 0.002);
  EXPECT_NEAR(clean.le68_m, 0.2, 0.002);
  EXPECT_NEAR(clean.le90_m, 1.6449 * 0.2, 0.004);
  for (int i = 0; i < 900; ++i) dsm.values(i % 300, 100 + i / 300) += 50;  // one in a hundred
  const HeightErrors dirty = compare_surfaces(dsm, truth, nullptr, {0.1}).overall;
  EXPECT_NEAR(dirty.nmad_m, 0.2, 0.006);
  EXPECT_GT(dirty.rmse_m, 4.9);
}

TEST(HeightAccuracy, holes_are_misses_in_the_share_of_all_and_no_matter_in_that_of_the_measured) {
  const auto truth = make_raster<float>(10, 10, at({0, 10}, 1), hills);
  auto dsm = truth;
  for (int i = 0; i < 10; ++i) dsm.values(i, 3) = kHole;
  const HeightErrors e = compare_surfaces(dsm, truth, nullptr, {0.1}).overall;
  EXPECT_EQ(e.valid_count, 90);
  EXPECT_DOUBLE_EQ(e.valid_share(), 0.9);
  EXPECT_DOUBLE_EQ(e.within_of_all[0], 0.9);
  EXPECT_DOUBLE_EQ(e.within_of_valid[0], 1);
}

TEST(HeightAccuracy, cells_without_truth_are_not_asked_for) {
  auto truth = make_raster<float>(10, 10, at({0, 10}, 1), hills);
  const auto dsm = truth;
  truth.values(0, 0) = kHole;
  EXPECT_EQ(compare_surfaces(dsm, truth, nullptr, {0.1}).overall.reference_count, 99);
}

TEST(HeightAccuracy, one_lattice_is_compared_cell_by_cell_even_beside_holes_and_far_from_the_origin) {
  const Vec2d far{691234.5, 5334567.1};
  const auto truth = make_raster<float>(20, 20, at(far, 0.1), [](Vec2d) { return 5.; });
  auto dsm = make_raster<float>(26, 24, at({far.x - 0.3, far.y + 0.2}, 0.1), [](Vec2d) { return 5.; });
  dsm.values(10, 10) = kHole;
  EXPECT_EQ(compare_surfaces(dsm, truth, nullptr, {0.1}).overall.valid_count, 399);
}

TEST(HeightAccuracy, other_lattices_are_interpolated_which_is_exact_on_a_plane_and_needs_all_four_neighbours) {
  const auto truth = make_raster<float>(20, 20, at({3.3, 17.7}, 0.25), slope);
  auto dsm = make_raster<float>(20, 20, at({0, 20}, 1), slope);
  const HeightErrors whole = compare_surfaces(dsm, truth, nullptr, {0.1}).overall;
  EXPECT_EQ(whole.valid_count, 400);
  EXPECT_NEAR(whole.rmse_m, 0, 1e-5);
  dsm.values(5, 5) = kHole;  // 2 m x 2 m around its centre become unknown: 8 x 8 cells of the truth
  EXPECT_EQ(compare_surfaces(dsm, truth, nullptr, {0.1}).overall.valid_count, 400 - 64);
}

TEST(HeightAccuracy, the_mask_picks_the_cells_above_zero) {
  const auto truth = make_raster<float>(10, 10, at({0, 10}, 1), hills);
  const auto dsm = make_raster<float>(10, 10, at({0, 10}, 1), [](Vec2d p) { return hills(p) + (p.x < 3 ? 1 : 0); });
  const auto mask = make_raster<std::uint8_t>(10, 10, at({0, 10}, 1), [](Vec2d p) { return p.x < 3 ? 2 : 0; });
  const HeightAccuracy a = compare_surfaces(dsm, truth, &mask, {0.1});
  EXPECT_EQ(a.masked->reference_count, 30);
  EXPECT_NEAR(a.masked->mean_m, 1, 1e-5);
  EXPECT_NEAR(a.overall.mean_m, 0.3, 1e-5);
}

TEST(HeightAccuracy, points_are_met_by_interpolation_and_those_outside_are_missing) {
  const auto dsm = make_raster<float>(20, 20, at({0, 20}, 1), slope);
  const std::vector<Vec3d> points = {
      {4.2, 9.9, slope({4.2, 9.9}) - 0.5}, {10, 10, slope({10, 10}) - 0.5}, {25, 10, 0}, {0.2, 10, 0}};
  const HeightErrors e = compare_points(dsm, points, {0.1}).overall;
  EXPECT_EQ(e.reference_count, 4);
  EXPECT_EQ(e.valid_count, 2);
  EXPECT_NEAR(e.mean_m, 0.5, 1e-5);
}

TEST(HeightAccuracy, nothing_to_compare_is_null_in_json_and_a_dash_in_the_table) {
  const auto dsm = make_raster<float>(4, 4, at({0, 4}, 1), [](Vec2d) { return kHole; });
  const HeightAccuracy none = compare_points(dsm, {}, {0.1});
  const auto json = nlohmann::json::parse(to_json(none));
  EXPECT_TRUE(json["overall"]["rmse_m"].is_null());
  EXPECT_TRUE(json["overall"]["valid_share"].is_null());
  EXPECT_TRUE(json["overall"]["within_1_gsd"]["of_all"].is_null());
  EXPECT_FALSE(json.contains("masked"));
  EXPECT_EQ(to_text(none).find("nan"), std::string::npos);
  const HeightAccuracy holes = compare_points(dsm, {{2, 2, 0}}, {0.1});
  EXPECT_EQ(nlohmann::json::parse(to_json(holes))["overall"]["within_1_gsd"]["of_all"], 0);
}

TEST(HeightAccuracy, json_gives_lengths_in_metres_and_gsd) {
  const auto truth = make_raster<float>(4, 4, at({0, 4}, 1), [](Vec2d) { return 0.; });
  const auto dsm = make_raster<float>(4, 4, at({0, 4}, 1), [](Vec2d) { return 0.5; });
  const auto json = nlohmann::json::parse(to_json(compare_surfaces(dsm, truth, nullptr, {0.25})));
  EXPECT_DOUBLE_EQ(json["overall"]["rmse_m"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(json["overall"]["rmse_gsd"].get<double>(), 2);
}

TEST(HeightAccuracy, what_cannot_be_compared_is_refused_with_a_sentence) {
  const auto truth = make_raster<float>(4, 4, at({0, 4}, 1), hills);
  EXPECT_THROW(compare_surfaces(truth, truth, nullptr, {0}), Error);
  auto utm = truth;
  utm.georeference.crs_wkt = raster::crs_from_user_input("EPSG:32632");
  EXPECT_THROW(compare_surfaces(utm, truth, nullptr, {0.1}), Error);
  const auto mask = make_raster<std::uint8_t>(4, 4, at({1, 4}, 1), [](Vec2d) { return 1; });
  EXPECT_THROW(compare_surfaces(truth, truth, &mask, {0.1}), Error);
}

}  // namespace
}  // namespace skysweep::report
