// SPDX-License-Identifier: Apache-2.0
// Scene files with objects, and what becomes of each key.
#include "scene/objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "scene/flight_plan.h"
#include "scene/scene_file.h"
#include "scene/world/roofs.h"
#include "scene/world/solids.h"
#include "scene/world/thin.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

const std::string kCamera = "[camera]\nwidth_px = 640\nheight_px = 480\nfocal_px = 600\n";

std::string refusal(const std::string& text) {
  try {
    parse_scene(text + kCamera, "s.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::string& words) {
  const std::string said = refusal(text);
  EXPECT_NE(said.find(words), std::string::npos) << text << "\n" << said;
}

Solids solids_of(const std::string& text) {
  const Scene scene = parse_scene(text + kCamera, "s.toml");
  const Ground ground(scene.terrain, scene.seed);
  std::optional<StreetPlan> streets;
  if (scene.town) streets.emplace(*scene.town, 0.5 * scene.area_m);
  return build_solids(scene, ground, streets, {{-100, -100}, {200, 200}});
}

int count_buildings(const Solids& solids) {
  return static_cast<int>(std::count_if(solids.boxes.begin(), solids.boxes.end(),
                                        [](const SolidBox& box) { return box.kind == BoxKind::building; }));
}

const std::string kHouse = "[[building]]\ncenter = [10, 10]\nsize_m = [8, 6]\nroof_z_m = 7\n";

TEST(Objects, every_table_is_read_and_told_again_in_json) {
  const Scene scene = parse_scene(
      kHouse +
          "roof = \"gable\"\neaves_z_m = 4\ncourtyard_m = [3, 2]\n"
          "[[tree]]\nposition = [1, 2]\nheight_m = 9\ncrown_m = 4\nshape = \"cone\"\n"
          "[forest]\ntrees_per_ha = 200\nmin_height_m = 5\nmax_height_m = 6\nshapes = [\"column\"]\narea = [1, 2, 3, "
          "4]\n"
          "[[wall]]\nfrom = [1, 2]\nto = [3, 4]\nheight_m = 3\nthickness_m = 0.2\n"
          "[[bridge]]\nfrom = [1, 2]\nto = [3, 4]\nwidth_m = 5\ndeck_z_m = 6\nthickness_m = 0.7\nramp_m = 8\n"
          "[[mast]]\nposition = [1, 2]\nheight_m = 20\nwidth_m = 0.4\n"
          "[[power_line]]\npylons = [1, 2, 3, 4]\nheight_m = 11\nsag_m = 0.5\nwires = 4\nwire_spacing_m = 2\n"
          "wire_diameter_m = 0.02\npylon_width_m = 0.5\n" +
          kCamera,
      "s.toml");
  EXPECT_EQ(scene.buildings[0].roof, RoofKind::gable);
  EXPECT_EQ(scene.buildings[0].eaves_z_m, 4);
  EXPECT_EQ(scene.buildings[0].courtyard_m->y, 2);
  EXPECT_EQ(scene.things.trees[0].shape, CrownShape::cone);
  EXPECT_EQ(scene.things.forest->shapes, std::vector{CrownShape::column});
  EXPECT_EQ(scene.things.forest->area->max.y, 4);
  EXPECT_EQ(scene.things.walls[0].thickness_m, 0.2);
  EXPECT_EQ(scene.things.bridges[0].ramp_m, 8);
  EXPECT_EQ(scene.things.masts[0].width_m, 0.4);
  EXPECT_EQ(scene.things.power_lines[0].pylons[1].y, 4);
  EXPECT_EQ(scene.things.power_lines[0].wires, 4);
  const std::string json = scene_to_json(scene);
  for (const char* word : {"eaves_z_m", "courtyard_m", "\"cone\"", "trees_per_ha", "thickness_m", "ramp_m", "mast",
                           "wire_diameter_m", "\"gable\"", "\"column\""})
    EXPECT_NE(json.find(word), std::string::npos) << word;
}

TEST(Objects, wrong_values_are_refused_with_the_key_and_what_it_may_be) {
  expect_refused(kHouse + "roof = \"dome\"\n", "\"flat\", \"gable\", \"hip\", \"shed\", \"saw_tooth\", not \"dome\"");
  expect_refused(kHouse + "roof = \"hip\"\n", "eaves_z_m of a building whose roof is not flat is missing");
  expect_refused(kHouse + "roof = \"hip\"\neaves_z_m = 7\n", "eaves_z_m must lie below roof_z_m");
  expect_refused(kHouse + "eaves_z_m = 5\n", "no effect on a flat roof");
  expect_refused(kHouse + "courtyard_m = [8, 2]\n", "courtyard_m must be smaller");
  expect_refused(kHouse + "roof = \"shed\"\neaves_z_m = 5\ncourtyard_m = [2, 2]\n", "needs a flat or gable roof");
  const std::string teeth = kHouse + "roof = \"saw_tooth\"\neaves_z_m = 5\n";
  expect_refused(teeth, "teeth (how many) of a building with a saw-tooth roof is missing");
  expect_refused(teeth + "teeth = 0\n", "teeth must lie between 1 and 1000");
  expect_refused(teeth + "teeth = 3\nsteep_deg = 20\n", "steep_deg must lie between 30 and 90");
  expect_refused(teeth + "teeth = 30\nsteep_deg = 60\n", "leaves less than a tenth");
  expect_refused(teeth + "teeth = 3\ncourtyard_m = [2, 2]\n", "needs a flat or gable roof");
  expect_refused(kHouse + "teeth = 3\n", "no effect without roof = \"saw_tooth\"");
  expect_refused(kHouse + "roof = \"shed\"\neaves_z_m = 5\nsteep_deg = 70\n", "no effect without roof");
  expect_refused("[[tree]]\nheight_m = 3\n", "position = [x, y] of a tree is missing");
  expect_refused("[[tree]]\nposition = [1, 1]\nshape = \"cube\"\n", "\"ellipsoid\", \"cone\", \"column\"");
  expect_refused("[[tree]]\nposition = [1, 1]\ncrown_m = 0\n", "crown_m must be above 0");
  expect_refused("[forest]\nmin_height_m = 9\nmax_height_m = 8\n", "max_height_m must not be below");
  expect_refused("[forest]\nshapes = []\n", "at least one crown shape");
  expect_refused("[forest]\narea = [5, 0, 4, 9]\n", "x0 <= x1");
  expect_refused("[forest]\ntrees_per_ha = 0\n", "trees_per_ha");
  expect_refused("[[wall]]\nfrom = [1, 1]\nto = [1, 1]\n", "to must lie elsewhere than from");
  expect_refused("[[wall]]\nfrom = [1, 1]\n", "to = [x, y] of a wall is missing");
  expect_refused("[[bridge]]\nfrom = [1, 1]\nto = [9, 1]\n", "deck_z_m of a bridge is missing");
  expect_refused("[[mast]]\nposition = [1, 1]\nwidth_m = 0\n", "width_m must be above 0");
  expect_refused("[[power_line]]\npylons = [1, 1]\n", "at least two pylons");
  expect_refused("[[power_line]]\npylons = [1, 1, 1, 1]\n", "one place twice");
  expect_refused("[[power_line]]\npylons = [1, 1, 9, 1]\nwires = 0\n", "wires must lie between 1 and 24");
  expect_refused("[town]\ngable_share = 0.6\nhip_share = 0.6\n", "add up to more than 1");
  expect_refused("[town]\npitched_up_to_m = 6\n", "no effect without gable_share");
  expect_refused("[town]\nalley_m = 20\n", "alley_m must lie between");
  expect_refused("[[tree]]\nposition = [1, 1]\ncolour = 3\n", "colour");
}

TEST(Objects, roofs_courtyards_and_trees_of_a_town_are_as_many_as_asked_for) {
  const std::string town = "[town]\nblock_m = 40\nmax_height_m = 9\nroof_units = 0\ncars_per_100m = 0\n";
  const Solids plain = solids_of(town);
  const int buildings = count_buildings(plain);
  EXPECT_TRUE(plain.facets.all.empty());
  EXPECT_TRUE(plain.trees.empty());

  const auto roofed = [&](const std::string& keys) { return solids_of(town + keys); };
  const Solids gabled = roofed("gable_share = 1\n"), some = roofed("gable_share = 0.3\n");
  const auto bodies = [](const Solids& solids) { return static_cast<int>(solids.facets.bodies.size()); };
  EXPECT_EQ(bodies(gabled) + count_buildings(gabled), buildings);  // the widest keep their level roof
  EXPECT_GT(bodies(gabled), buildings / 4);
  EXPECT_GT(bodies(some), 0);
  EXPECT_LT(bodies(some), 0.6 * bodies(gabled));
  EXPECT_NE(roofed("hip_share = 1\n").facets.all[0].corner, gabled.facets.all[0].corner);
  EXPECT_NE(roofed("shed_share = 1\n").facets.all[0].corner, gabled.facets.all[0].corner);
  EXPECT_EQ(bodies(roofed("gable_share = 1\npitched_up_to_m = 1\n")), 0);  // none is that low

  const Solids yards = roofed("courtyard_share = 1\n");
  EXPECT_GT(bodies(yards), 5);
  EXPECT_EQ(bodies(yards) + count_buildings(yards), buildings);

  const Solids green = roofed("trees_per_block = 4\n");
  EXPECT_GT(green.trees.size(), 20u);
  EXPECT_EQ(count_buildings(green), buildings);
  for (const TreeInstance& tree : green.trees)
    for (const SolidBox& box : green.boxes) {
      const Vec2d q = box.local({tree.foot.x, tree.foot.y});
      EXPECT_FALSE(std::abs(q.x) < box.half.x + tree.radius_m && std::abs(q.y) < box.half.y + tree.radius_m);
    }
}

TEST(Objects, keys_of_a_town_that_are_off_change_nothing_else_in_it) {
  const std::string town = "[town]\nmax_height_m = 9\n";
  const Solids plain = solids_of(town), green = solids_of(town + "trees_per_block = 3\n");
  ASSERT_EQ(plain.boxes.size(), green.boxes.size());
  for (std::size_t i = 0; i < plain.boxes.size(); ++i) {
    EXPECT_EQ(plain.boxes[i].center, green.boxes[i].center);
    EXPECT_EQ(plain.boxes[i].z_high, green.boxes[i].z_high);
    EXPECT_EQ(plain.boxes[i].seed, green.boxes[i].seed);
  }
  const Scene scene = parse_scene(town + kCamera, "s.toml");
  const std::string json = scene_to_json(scene);
  EXPECT_EQ(json.find("gable_share"), std::string::npos);
  EXPECT_EQ(json.find("forest"), std::string::npos);
}

TEST(Objects, with_alleys_the_buildings_of_a_block_stand_that_far_apart) {
  const Solids solids = solids_of(
      "[town]\nblock_m = 27\nblock_depth_m = 24\nstreet_m = 9\nalley_m = 3\nroof_units = 0\ncars_per_100m = 0\n");
  double nearest = 1e9, deepest = 0;
  for (const SolidBox& a : solids.boxes) {
    deepest = std::max(deepest, 2 * a.half.y);
    for (const SolidBox& b : solids.boxes) {
      const Vec2d q = a.local(b.center);
      const double gap = std::max(std::abs(q.x) - a.half.x - b.half.x, std::abs(q.y) - a.half.y - b.half.y);
      if (&a != &b) nearest = std::min(nearest, gap);
    }
  }
  EXPECT_NEAR(nearest, 3, 1e-9);
  EXPECT_NEAR(deepest, 24, 1e-9);  // and fill their lots
}

TEST(Objects, a_forest_has_its_density_and_keeps_to_its_area_and_off_the_streets) {
  const Solids wood =
      solids_of("[forest]\ntrees_per_ha = 400\nmin_height_m = 5\nmax_height_m = 8\narea = [0, 0, 100, 50]\n");
  EXPECT_NEAR(static_cast<double>(wood.trees.size()), 200, 20);
  for (const TreeInstance& tree : wood.trees) {
    EXPECT_TRUE((Box2d{{0, 0}, {100, 50}}).contains({tree.foot.x, tree.foot.y}));
    EXPECT_GE(tree.height_m, 5);
    EXPECT_LE(tree.height_m, 8);
  }
  const Solids firs = solids_of("[forest]\nshapes = [\"cone\"]\narea = [0, 0, 50, 50]\n");
  for (const TreeInstance& tree : firs.trees) EXPECT_EQ(tree.prototype / kVariantsPerShape, 1);

  const Solids park = solids_of("[town]\ncars_per_100m = 0\n[forest]\narea = [0, 0, 100, 100]\n");
  EXPECT_GT(park.trees.size(), 50u);
  EXPECT_GT(count_buildings(park), 50);
  for (const TreeInstance& tree : park.trees)
    for (const SolidBox& box : park.boxes) {
      const Vec2d q = box.local({tree.foot.x, tree.foot.y});
      EXPECT_FALSE(std::abs(q.x) < box.half.x && std::abs(q.y) < box.half.y);
    }
}

TEST(Objects, nothing_reaches_above_the_bound_on_which_flights_are_checked) {
  for (const char* text :
       {"[town]\nmax_height_m = 12\nroof_units = 0\ngable_share = 0.4\nhip_share = 0.3\nshed_share = "
        "0.3\ntrees_per_block = 9\n",
        "[forest]\nmax_height_m = 31\n", "[[tree]]\nposition = [5, 5]\nheight_m = 40\n",
        "[[mast]]\nposition = [5, 5]\nheight_m = 60\n", "[[wall]]\nfrom = [5, 5]\nto = [9, 9]\nheight_m = 9\n",
        "[[bridge]]\nfrom = [5, 5]\nto = [9, 9]\ndeck_z_m = 30\n",
        "[[power_line]]\npylons = [5, 5, 50, 50]\nheight_m = 44\n"}) {
    const Scene scene = parse_scene(text + kCamera, "s.toml");
    EXPECT_LE(solids_of(text).highest_m(), tallest_object_m(scene)) << text;
    EXPECT_GT(tallest_object_m(scene), 8) << text;
  }
}

TEST(Objects, saw_teeth_are_read_and_told_again_in_json) {
  const Scene scene =
      parse_scene(kHouse + "roof = \"saw_tooth\"\neaves_z_m = 5\nteeth = 3\nsteep_deg = 80\n" + kCamera, "s.toml");
  EXPECT_EQ(scene.buildings[0].roof, RoofKind::saw_tooth);
  EXPECT_EQ(scene.buildings[0].teeth, 3);
  EXPECT_EQ(scene.buildings[0].steep_deg, 80);
  const std::string json = scene_to_json(scene);
  for (const char* word : {"\"saw_tooth\"", "\"teeth\"", "\"steep_deg\""})
    EXPECT_NE(json.find(word), std::string::npos) << word;
}

// Geometry, Embree's trees and all: what a run holds besides photographs and truth rasters.
TEST(Objects, a_square_kilometre_of_town_fits_into_two_gigabytes) {
  const char* folder = std::getenv("SKYSWEEP_SCENES");
  if (!folder) GTEST_SKIP() << "SKYSWEEP_SCENES does not name config/scenes";
  const Scene scene = read_scene(std::string(folder) + "/town_1km2.toml");
  EXPECT_GE(scene.area_m.x * scene.area_m.y, 1e6);
  const auto poses = plan_flight(scene);
  EXPECT_GT(poses.size(), 100u);
  EXPECT_LT(poses.size(), 250u);
  const auto world = std::make_unique<World>(scene, visible_ground(scene, poses));
  EXPECT_GT(world->solids().boxes.size() + world->solids().facets.bodies.size(), 4000u);
  EXPECT_GT(world->solids().trees.size(), 2000u);
  std::ifstream status("/proc/self/status");
  double peak_mib = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) peak_mib = std::stod(line.substr(6)) / 1024;
  RecordProperty("peak_mib", std::to_string(peak_mib));
  // Photographs of 12 megapixels and the truth at 20 cm take another 0.5 GB.
  EXPECT_GT(peak_mib, 10);
  EXPECT_LT(peak_mib, 1500);
}

}  // namespace
}  // namespace skysweep::scene
