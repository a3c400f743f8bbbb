// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "formats/pose_writers.h"
#include "scene/flight_plan.h"
#include "scene/scene_file.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

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

void expect_refused(const std::string& text, const std::string& words) {
  EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
}

TEST(FlightFile, every_key_of_strips_is_read) {
  const Flight flight = parse_scene(kCamera +
                                        "[flight]\naltitudes_m = [60, 80.5]\ncross_strips = true\n"
                                        "terrain_following = true\noff_nadir_deg = 40\nlooks_deg = [0, 90]\n"
                                        "drift_sigma_m = 1.5\ntilt_drift_sigma_deg = 0.5\ndrift_photographs = 7\n",
                                    "s.toml")
                            .flight;
  EXPECT_EQ(flight.altitudes_m, (std::vector<double>{60, 80.5}));
  EXPECT_TRUE(flight.cross_strips);
  EXPECT_TRUE(flight.terrain_following);
  EXPECT_EQ(flight.looks_deg, (std::vector<double>{0, 90}));
  EXPECT_EQ(flight.drift_sigma_m, 1.5);
  EXPECT_EQ(flight.tilt_drift_sigma_deg, 0.5);
  EXPECT_EQ(flight.drift_photographs, 7);
  EXPECT_DOUBLE_EQ(flight.resolved_gsd_m(600), 0.1);
}

TEST(FlightFile, an_orbit_has_the_middle_of_the_area_for_a_target_unless_told_otherwise) {
  const std::string orbit =
      "area_m = [50, 40]\n" + kCamera + "[flight]\npattern = \"orbit\"\nradius_m = 30\naltitudes_m = [40]\n";
  const Flight flight = parse_scene(orbit + "photographs = 8\n", "s.toml").flight;
  EXPECT_EQ(flight.pattern, FlightPattern::orbit);
  EXPECT_EQ(flight.target, (Vec3d{25, 20, 0}));
  EXPECT_EQ(flight.photographs, 8);
  EXPECT_EQ(parse_scene(orbit + "target = [1, 2, 3]\n", "s.toml").flight.target, (Vec3d{1, 2, 3}));
}

TEST(FlightFile, several_flights_are_flown_in_their_order) {
  const Scene scene =
      parse_scene(kCamera + "[[flight]]\ngsd_m = 0.1\n[[flight]]\ngsd_m = 0.05\nheading_deg = 90\n", "s.toml");
  EXPECT_EQ(scene.flight.gsd_m, 0.1);
  ASSERT_EQ(scene.further_flights.size(), 1u);
  EXPECT_EQ(scene.further_flights[0].heading_deg, 90);
  EXPECT_EQ(scene.gsd_m(), 0.05);
  EXPECT_EQ(scene.altitude_m(), 60);
}

TEST(FlightFile, a_camera_may_have_two_focal_lengths) {
  const Scene scene = parse_scene(kCamera + "focal_y_px = 610\n", "s.toml");
  EXPECT_EQ(scene.camera.fx_px, 600);
  EXPECT_EQ(scene.camera.fy_px, 610);
  EXPECT_NE(scene_to_json(scene).find("\"focal_y_px\": 610"), std::string::npos);
  EXPECT_EQ(scene_to_json(parse_scene(kCamera, "s.toml")).find("focal_y_px"), std::string::npos);
}

class GivenPoses : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("given_poses_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const camera::CameraModel model{320, 240, 300, 301, 161, 119, {-0.1, 0.02, 0.001, -0.001, 0.003}};
    for (int i = 0; i < 3; ++i)
      images_.push_back({"view" + std::to_string(i) + ".jpg",
                         model,
                         {camera::rotation_from_yaw_pitch_roll(30 * i, -80, 2), {1010. + i, 2010, 330}},
                         ""});
  }
  Scene read(const std::string& text) {
    formats::write_poses_csv((folder_ / "flown.csv").string(), images_);
    std::ofstream(folder_ / "s.toml") << text;
    return read_scene(folder_ / "s.toml");
  }
  fs::path folder_;
  std::vector<formats::PosedImage> images_;
};

TEST_F(GivenPoses, are_flown_as_they_are_with_the_camera_of_their_file) {
  const Scene scene = read("origin = [1000, 2000, 300]\n[flight]\nposes = \"flown.csv\"\n");
  EXPECT_EQ(scene.camera, images_[0].model);
  const std::vector<camera::Pose> poses = plan_flight(scene);
  ASSERT_EQ(poses.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const camera::Pose& pose = poses[static_cast<std::size_t>(i)];
    EXPECT_EQ(pose.center, (Vec3d{10. + i, 10, 30}));
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(pose.cam_from_world.m[static_cast<std::size_t>(k)],
                  images_[static_cast<std::size_t>(i)].pose.cam_from_world.m[static_cast<std::size_t>(k)], 1e-14);
  }
  EXPECT_DOUBLE_EQ(scene.gsd_m(), 30 / scene.camera.focal_px());
}

TEST_F(GivenPoses, are_flown_with_the_camera_of_the_scene_if_it_has_one) {
  EXPECT_EQ(read("[flight]\nposes = \"flown.csv\"\n" + kCamera).camera.width_px, 640);
}

TEST_F(GivenPoses, of_several_cameras_need_one_in_the_scene) {
  images_[1].model.fx_px = 299;
  EXPECT_THROW(read("[flight]\nposes = \"flown.csv\"\n"), Error);
  EXPECT_NO_THROW(read("[flight]\nposes = \"flown.csv\"\n" + kCamera));
}

TEST_F(GivenPoses, leave_nothing_to_other_keys) {
  EXPECT_THROW(read("[flight]\nposes = \"flown.csv\"\ngsd_m = 0.1\n"), Error);
  EXPECT_THROW(read("[flight]\nposes = \"absent.csv\"\n"), Error);
}

TEST(FlightFile, what_has_no_effect_on_a_pattern_is_refused) {
  const std::string orbit = kCamera + "[flight]\npattern = \"orbit\"\nradius_m = 30\naltitudes_m = [40]\n";
  expect_refused(orbit + "along_overlap = 0.5\n", "along_overlap has no effect on an orbit");
  expect_refused(orbit + "terrain_following = true\n", "terrain_following has no effect");
  expect_refused(kCamera + "[flight]\nradius_m = 3\n", "radius_m has no effect on strips");
  expect_refused(kCamera + "[flight]\ngsd_m = 0.1\naltitudes_m = [40]\n", "gsd_m has no effect");
  expect_refused(kCamera + "[flight]\ndrift_photographs = 5\n", "drift_photographs has no effect");
}

TEST(FlightFile, wrong_values_are_refused_with_the_key_and_what_it_may_be) {
  const std::string orbit = kCamera + "[flight]\npattern = \"orbit\"\n";
  expect_refused(orbit + "radius_m = 30\n", "altitudes_m of an orbit is missing");
  expect_refused(orbit + "altitudes_m = [30]\n", "radius_m of an orbit is missing");
  expect_refused(orbit + "radius_m = 0\naltitudes_m = [30]\n", "radius_m must be above 0");
  expect_refused(orbit + "radius_m = 9\naltitudes_m = [30]\ntarget = [1, 2, 30]\n", "above the height of the target");
  expect_refused(orbit + "radius_m = 9\naltitudes_m = [30]\ntarget = [1, 2]\n", "3 numbers");
  expect_refused(orbit + "radius_m = 9\naltitudes_m = [30]\nphotographs = 0\n", "between 1 and 9999");
  expect_refused(kCamera + "[flight]\npattern = \"spiral\"\n", "spiral");
  expect_refused(kCamera + "[flight]\naltitudes_m = []\n", "at least one");
  expect_refused(kCamera + "[flight]\naltitudes_m = [50, -1]\n", "altitudes above 0");
  expect_refused(kCamera + "[flight]\nlooks_deg = [400]\n", "between -360 and 360");
  expect_refused(kCamera + "[flight]\ndrift_sigma_m = -1\n", "drift_sigma_m must be at least 0");
  expect_refused(kCamera + "focal_y_px = 0\n", "focal_y_px must be above 0");
}

}  // namespace
}  // namespace skysweep::scene
