// SPDX-License-Identifier: Apache-2.0
#include "index/view_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/random.h"

namespace skysweep::index {
namespace {

using camera::Camera;

// From 100 m this camera shows 133 m x 100 m of flat ground.
const camera::CameraModel kModel{4000, 3000, 3000, 3000, 2000, 1500, {}};
const Box2d kTile{{0, 0}, {51.2, 51.2}};
const Vec2d kMiddle{25.6, 25.6};

ViewCandidate view(const std::string& name, Vec3d center, double pitch_deg = -90, double yaw_deg = 0) {
  return {name, Camera(kModel, {camera::rotation_from_yaw_pitch_roll(yaw_deg, pitch_deg, 0), center})};
}

// A lawn-mower flight 100 m above the tile: strips from south to north, 80 % forward and 60 % side overlap.
std::vector<ViewCandidate> lawn_mower() {
  std::vector<ViewCandidate> views;
  for (int strip = -3; strip <= 3; ++strip)
    for (int i = -8; i <= 8; ++i)
      views.push_back(view("strip" + std::to_string(strip + 3) + "_" + std::to_string(i + 108),
                           {kMiddle.x + 53 * strip, kMiddle.y + 20 * i + 5, 100}));
  return views;
}

std::set<std::string> names(const std::vector<ViewCandidate>& candidates, const ViewSelection& selection) {
  std::set<std::string> chosen;
  for (const int position : selection.chosen) chosen.insert(candidates[position].name);
  return chosen;
}

int times_shown(const std::vector<ViewCandidate>& candidates, const ViewSelection& selection, Vec3d point) {
  return static_cast<int>(std::count_if(selection.chosen.begin(), selection.chosen.end(), [&](int position) {
    const auto pixel = candidates[position].camera.project(point);
    return pixel && candidates[position].camera.shows(*pixel);
  }));
}

TEST(ViewSelection, of_a_lawn_mower_flight_shows_all_of_the_tile_several_times) {
  const auto candidates = lawn_mower();
  const ViewSelection selection = select_views(candidates, kTile, 0, 10, {});
  EXPECT_LT(selection.chosen.size(), candidates.size());
  for (double y = 0; y <= 51.2; y += 3.2)
    for (double x = 0; x <= 51.2; x += 3.2)
      for (const double z : {0.0, 10.0}) EXPECT_GE(times_shown(candidates, selection, {x, y, z}), 3) << x << ", " << y;
}

TEST(ViewSelection, spreads_around_the_tile) {
  const auto candidates = lawn_mower();
  const ViewSelection selection = select_views(candidates, kTile, 0, 10, {});
  double north = 0, south = 0, east = 0, west = 0;
  for (const int position : selection.chosen) {
    const Vec3d center = candidates[position].camera.pose().center;
    north = std::max(north, center.y - kMiddle.y), south = std::max(south, kMiddle.y - center.y);
    east = std::max(east, center.x - kMiddle.x), west = std::max(west, kMiddle.x - center.x);
  }
  for (const double reach_m : {north, south, east, west}) EXPECT_GE(reach_m, 20);
}

TEST(ViewSelection, does_not_depend_on_the_order_of_the_candidates) {
  auto candidates = lawn_mower();
  const auto expected = names(candidates, select_views(candidates, kTile, 0, 10, {}));
  Random random(41);
  for (int trial = 0; trial < 20; ++trial) {
    for (std::size_t i = candidates.size() - 1; i > 0; --i)
      std::swap(candidates[i], candidates[random.below(static_cast<int>(i) + 1)]);
    const ViewSelection selection = select_views(candidates, kTile, 0, 10, {});
    EXPECT_EQ(names(candidates, selection), expected);
    for (std::size_t i = 0; i < candidates.size(); ++i) EXPECT_EQ(selection.verdicts[i].name, candidates[i].name);
    EXPECT_TRUE(std::is_sorted(selection.chosen.begin(), selection.chosen.end(),
                               [&](int a, int b) { return candidates[a].name < candidates[b].name; }));
  }
}

TEST(ViewSelection, does_not_depend_on_photographs_that_do_not_show_the_tile) {
  auto candidates = lawn_mower();
  const auto expected = names(candidates, select_views(candidates, kTile, 0, 10, {}));
  std::erase_if(candidates, [](const ViewCandidate& c) { return norm(c.camera.pose().center) > 250; });
  ASSERT_LT(candidates.size(), lawn_mower().size());
  EXPECT_EQ(names(candidates, select_views(candidates, kTile, 0, 10, {})), expected);
}

TEST(ViewSelection, takes_no_two_photographs_from_one_position) {
  // A drone that hovers: many photographs at each of three places.
  std::vector<ViewCandidate> candidates;
  for (int i = 0; i < 12; ++i) {
    const std::string number = std::to_string(10 + i);
    candidates.push_back(view("a" + number, {5, 25, 100}));
    candidates.push_back(view("b" + number, {25, 25, 100}));
    candidates.push_back(view("c" + number, {45, 25, 100}));
  }
  const ViewSelection selection = select_views(candidates, kTile, 0, 0, {});
  EXPECT_EQ(names(candidates, selection), (std::set<std::string>{"a10", "b10", "c10"}));
  EXPECT_EQ(selection.verdicts[5].name, "c11");
  EXPECT_EQ(selection.verdicts[5].reason, "same position as c10");
}

TEST(ViewSelection, leaves_out_views_closer_than_the_least_baseline) {
  const std::vector<ViewCandidate> candidates = {view("a", {25, 25, 100}), view("b", {28, 25, 100}),
                                                 view("c", {45, 25, 100})};
  const ViewSelection selection = select_views(candidates, kTile, 0, 0, {});
  EXPECT_EQ(selection.chosen, (std::vector<int>{0, 2}));
  EXPECT_EQ(selection.verdicts[1].reason,
            "sees the tile from the same side as a, 3 m away: a baseline below 5 % of the depth");
  ViewSelectionOptions closer;
  closer.min_baseline_ratio = 0.02;
  EXPECT_EQ(select_views(candidates, kTile, 0, 0, closer).chosen.size(), 3u);
}

TEST(ViewSelection, serves_a_border_that_few_show_as_often_as_it_can) {
  // Four good views of all but the eastern border, three poor ones of nothing but the border.
  std::vector<ViewCandidate> candidates;
  for (int i = 0; i < 4; ++i) candidates.push_back(view("west" + std::to_string(i), {-20, 3 + 15.0 * i, 100}));
  for (int i = 0; i < 3; ++i) candidates.push_back(view("east" + std::to_string(i), {115, 5 + 20.0 * i, 100}));
  ViewSelectionOptions options;
  options.views_per_place = 3;
  options.max_views = 6;
  const ViewSelection selection = select_views(candidates, kTile, 0, 0, options);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(names(candidates, selection).count("east" + std::to_string(i)));
  EXPECT_GE(times_shown(candidates, selection, {51.2, 25, 0}), 3);
}

TEST(ViewSelection, prefers_the_finer_ground_sampling_distance) {
  const std::vector<ViewCandidate> candidates = {view("high", {20, 25, 300}), view("low", {20, 25, 100}),
                                                 view("other", {50, 25, 100})};
  const ViewSelection selection = select_views(candidates, kTile, 0, 0, {});
  EXPECT_LT(selection.verdicts[1].rank, selection.verdicts[0].rank == 0 ? 100 : selection.verdicts[0].rank);
  EXPECT_DOUBLE_EQ(selection.verdicts[1].gsd_m, 100.0 / 3000);
  EXPECT_DOUBLE_EQ(selection.verdicts[0].gsd_m, 0.1);
}

TEST(ViewSelection, rejects_oblique_views_and_says_how_steep) {
  // 60 degrees from nadir, pointed at the middle of the tile.
  const double away = 100 * std::tan(std::acos(0.5));
  std::vector<ViewCandidate> candidates = {view("nadir", {20, 25, 100}),
                                           view("oblique", {kMiddle.x, kMiddle.y - away, 100}, -30)};
  ViewSelection selection = select_views(candidates, {kMiddle, kMiddle + Vec2d{0.1, 0.1}}, 0, 0, {});
  EXPECT_EQ(selection.chosen, std::vector<int>{0});
  EXPECT_EQ(selection.verdicts[1].reason, "60 degrees from nadir, more than 40");
  EXPECT_NEAR(selection.verdicts[1].off_nadir_deg, 60, 0.1);
  ViewSelectionOptions steeper;
  steeper.max_off_nadir_deg = 70;
  selection = select_views(candidates, {kMiddle, kMiddle + Vec2d{0.1, 0.1}}, 0, 0, steeper);
  EXPECT_EQ(selection.chosen.size(), 2u);
}

TEST(ViewSelection, counts_a_point_by_the_heights_at_which_it_is_shown) {
  // A tower of 60 m: from 100 m its top appears outside the photographs that show its foot.
  const std::vector<ViewCandidate> candidates = {view("side", {kMiddle.x + 50, kMiddle.y, 100}),
                                                 view("above", {kMiddle.x, kMiddle.y, 100})};
  const Box2d tower{kMiddle, kMiddle + Vec2d{1, 1}};
  const ViewSelection flat = select_views(candidates, tower, 0, 0, {});
  const ViewSelection tall = select_views(candidates, tower, 0, 60, {});
  EXPECT_DOUBLE_EQ(flat.verdicts[0].coverage, 1);
  EXPECT_NEAR(tall.verdicts[0].coverage, 1.0 / 3, 1e-9);
  EXPECT_DOUBLE_EQ(tall.verdicts[1].coverage, 1);
}

TEST(ViewSelection, explains_every_candidate) {
  auto candidates = lawn_mower();
  candidates.push_back(view("zz_sky", {25, 25, 100}, 90));
  candidates.push_back(view("zz_below", {25, 25, -20}));
  candidates.push_back(view("zz_oblique", {kMiddle.x, kMiddle.y - 173, 100}, -30));
  const ViewSelection selection = select_views(candidates, kTile, 0, 10, {});
  ASSERT_EQ(selection.verdicts.size(), candidates.size());
  std::multiset<int> ranks;
  for (const ViewVerdict& verdict : selection.verdicts) {
    EXPECT_FALSE(verdict.name.empty());
    EXPECT_FALSE(verdict.reason.empty()) << verdict.name;
    EXPECT_EQ(verdict.chosen, verdict.rank > 0) << verdict.name;
    EXPECT_GE(verdict.coverage, 0);
    EXPECT_LE(verdict.coverage, 1);
    EXPECT_EQ(verdict.reason == "does not show the tile", verdict.coverage == 0) << verdict.name;
    if (verdict.chosen) ranks.insert(verdict.rank);
  }
  int expected = 0;
  for (const int rank : ranks) EXPECT_EQ(rank, ++expected);
  EXPECT_EQ(selection.chosen.size(), ranks.size());
}

TEST(ViewSelection, of_no_candidates_is_empty) {
  const ViewSelection selection = select_views({}, kTile, 0, 10, {});
  EXPECT_TRUE(selection.chosen.empty());
  EXPECT_TRUE(selection.verdicts.empty());
}

TEST(ViewSelection, keeps_to_the_largest_number_of_views) {
  const auto candidates = lawn_mower();
  for (const int views : {2, 3, 5}) {
    ViewSelectionOptions options;
    options.views_per_place = options.max_views = views;
    EXPECT_EQ(select_views(candidates, kTile, 0, 10, options).chosen.size(), static_cast<std::size_t>(views));
  }
}

TEST(ViewSelection, goes_on_until_every_place_is_shown_often_enough_and_then_stops) {
  const auto candidates = lawn_mower();
  for (const int times : {2, 4, 6}) {
    ViewSelectionOptions options;
    options.views_per_place = times;
    const ViewSelection selection = select_views(candidates, kTile, 0, 0, options);
    for (const Vec2d corner : {kTile.min, kTile.max, Vec2d{kTile.min.x, kTile.max.y}, kMiddle})
      EXPECT_GE(times_shown(candidates, selection, {corner.x, corner.y, 0}), times);
    EXPECT_LT(selection.chosen.size(), candidates.size());
  }
}

TEST(ViewSelectionOptions, each_changes_the_choice) {
  // Many views straight above the tile's western part, few and steep ones of its eastern border.
  std::vector<ViewCandidate> candidates;
  for (int i = 0; i < 12; ++i) candidates.push_back(view("w" + std::to_string(10 + i), {-20.0 - i, 4.0 * i, 100}));
  for (int i = 0; i < 3; ++i) candidates.push_back(view("e" + std::to_string(i), {115, 5 + 20.0 * i, 100}));
  const auto chosen_with = [&](auto change) {
    ViewSelectionOptions options;
    options.views_per_place = 3;
    options.max_views = 6;
    change(options);
    return names(candidates, select_views(candidates, kTile, 0, 0, options));
  };
  const auto usual = chosen_with([](auto&) {});
  EXPECT_NE(chosen_with([](auto& o) { o.max_views = 3; }), usual);
  EXPECT_NE(chosen_with([](auto& o) { o.max_off_nadir_deg = 25; }), usual);
  EXPECT_NE(chosen_with([](auto& o) { o.min_baseline_ratio = 0.2; }), usual);
  EXPECT_NE(chosen_with([](auto& o) { o.full_baseline_ratio = 0.051; }), usual);
  EXPECT_NE(chosen_with([](auto& o) { o.views_per_place = 2; }), usual);
}

TEST(ViewSelectionOptions, says_what_to_change) {
  EXPECT_FALSE(ViewSelectionOptions{}.problem());
  const auto problem_with = [](auto change) {
    ViewSelectionOptions options;
    change(options);
    return options.problem().value_or("");
  };
  EXPECT_EQ(problem_with([](auto& o) { o.views_per_place = 1; }).find("views_per_place"), 0u);
  EXPECT_EQ(problem_with([](auto& o) { o.max_off_nadir_deg = 0; }).find("max_off_nadir_deg"), 0u);
  EXPECT_EQ(problem_with([](auto& o) { o.max_off_nadir_deg = std::nan(""); }).find("max_off_nadir_deg"), 0u);
  EXPECT_EQ(problem_with([](auto& o) { o.min_baseline_ratio = -0.1; }).find("min_baseline_ratio"), 0u);
  EXPECT_EQ(problem_with([](auto& o) { o.full_baseline_ratio = 0.01; }).find("full_baseline_ratio"), 0u);
  EXPECT_EQ(problem_with([](auto& o) { o.max_views = 4; }).find("max_views"), 0u);
}

TEST(ViewSelectionDeathTest, two_candidates_of_one_name_are_a_bug) {
  EXPECT_DEATH(select_views({view("a", {0, 0, 100}), view("a", {9, 0, 100})}, kTile, 0, 0, {}), "name");
}

}  // namespace
}  // namespace skysweep::index
