// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/error.h"
#include "scene/effects/scene_effects.h"
#include "scene/flight_plan.h"

namespace skysweep::scene {
namespace {

const std::string kCamera = "[camera]\nwidth_px = 640\nheight_px = 480\nfocal_px = 600\n";

std::string refusal(const std::string& text) {
  try {
    parse_scene(text, "s.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "accepted";
}

TEST(SceneFile, what_is_absent_has_its_default) {
  const Scene scene = parse_scene(kCamera, "s.toml");
  EXPECT_FALSE(scene.town);
  EXPECT_EQ(scene.camera.cx_px, 320);
  EXPECT_EQ(scene.photographs.noise_sigma, 0);
  EXPECT_DOUBLE_EQ(scene.finest_detail_m(), 0.025);
  EXPECT_DOUBLE_EQ(scene.truth_cell_m(), 0.1);
}

TEST(SceneFile, every_kind_of_table_is_read) {
  const Scene scene = parse_scene(
      "origin = [691000, 5334000, 500]\ncrs = \"EPSG:32632\"\narea_m = [50, 40]\n[town]\n"
      "street_m = 9\n[[building]]\ncenter = [10, 20]\nsize_m = [8, 6]\nroof_z_m = 7\n"
      "[[building]]\ncenter = [30, 20]\nsize_m = [8, 6]\nroof_z_m = 9\n[photographs]\n"
      "format = \"png\"\nnoise_sigma = 2\n" +
          kCamera + "distortion = [-0.1, 0.01, 0, 0, 0]\nprincipal_point_px = [321, 239]\n",
      "s.toml");
  EXPECT_EQ(scene.origin, (Vec3d{691000, 5334000, 500}));
  EXPECT_EQ(scene.town->street_m, 9);
  ASSERT_EQ(scene.buildings.size(), 2u);
  EXPECT_EQ(scene.buildings[1].roof_z_m, 9);
  EXPECT_EQ(scene.photographs.format, PhotoFormat::png);
  EXPECT_EQ(scene.camera.distortion.k1, -0.1);
  EXPECT_EQ(scene.camera.cy_px, 239);
}

bool names_effects(const std::filesystem::path& scene) {
  std::ifstream in(scene);
  return std::string(std::istreambuf_iterator<char>(in), {}).find("\n[effects") != std::string::npos;
}

TEST(SceneFile, the_scenes_that_come_with_the_program_can_be_read_and_flown) {
  const char* folder = std::getenv("SKYSWEEP_SCENES");
  if (!folder) GTEST_SKIP() << "SKYSWEEP_SCENES does not name config/scenes";
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (nothing_runs().empty() && names_effects(entry.path())) continue;  // this build has no effects
    const Scene scene = read_scene(entry.path());
    EXPECT_GE(plan_flight(scene).size(), 4u) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 2);
}

TEST(SceneFile, an_unknown_key_is_refused_by_name) {
  EXPECT_NE(refusal(kCamera + "[flight]\nalong_overlapp = 0.8\n").find("along_overlapp"), std::string::npos);
  EXPECT_NE(refusal("seeed = 3\n" + kCamera).find("seeed"), std::string::npos);
  EXPECT_NE(
      refusal(kCamera + "[[building]]\ncenter = [1, 1]\nsize_m = [2, 2]\nroof_z_m = 3\ncolor = 1\n").find("color"),
      std::string::npos);
}

TEST(SceneFile, wrong_values_are_refused_with_the_key_and_what_it_may_be) {
  EXPECT_NE(refusal(kCamera + "[flight]\ngsd_m = 0\n").find("gsd_m must be above 0"), std::string::npos);
  EXPECT_NE(refusal(kCamera + "[flight]\nalong_overlap = 1\n").find("between 0 and 0.99"), std::string::npos);
  EXPECT_NE(refusal(kCamera + "[town]\nmin_height_m = 9\nmax_height_m = 5\n").find("max_height_m"), std::string::npos);
  EXPECT_NE(refusal("area_m = [1, 2, 3]\n" + kCamera).find("2 numbers"), std::string::npos);
  EXPECT_NE(refusal(kCamera + "[photographs]\nformat = \"gif\"\n").find("gif"), std::string::npos);
  EXPECT_NE(refusal("seed = 2\n").find("[camera]"), std::string::npos);
  EXPECT_NE(refusal("[camera]\nwidth_px = 10\nheight_px = 10\n").find("focal_px"), std::string::npos);
}

TEST(SceneFile, an_option_without_effect_is_refused) {
  EXPECT_NE(refusal(kCamera + "[photographs]\nformat = \"png\"\njpeg_quality = 80\n").find("no effect"),
            std::string::npos);
}

}  // namespace
}  // namespace skysweep::scene
