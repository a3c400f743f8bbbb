// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

class OpenSfm : public TestFolder {
 protected:
  PoseSet read(const std::string& content) const { return read_poses(write("reconstruction.json", content)); }
  std::string refusal(const std::string& content) const {
    return sentence_of([&] { read(content); });
  }
};

// Half a turn about x: nadir, north at the top, at (100, 200, 50).
const std::string kNadir = R"("rotation": [3.141592653589793, 0, 0], "translation": [-100, 200, 50])";
const std::string kPerspective =
    R"("c": {"projection_type": "perspective", "width": 4000, "height": 3000, "focal": 0.25, "k1": -0.1, "k2": 0.2})";

std::string joined(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text.append(text.empty() ? "" : ", ").append(item);
  return text;
}
std::string file_of(const std::vector<std::string>& reconstructions) {
  return std::string("[").append(joined(reconstructions)).append("]");
}
std::string reconstruction(const std::string& cameras, const std::vector<std::string>& shots,
                           const std::string& more = "") {
  return R"({"cameras": {)" + cameras + R"(}, "shots": {)" + joined(shots) + "}" + more + "}";
}
std::string shot(const std::string& name, const std::string& camera = "c", const std::string& pose = kNadir) {
  return "\"" + name + "\": {\"camera\": \"" + camera + "\", " + pose + "}";
}

TEST_F(OpenSfm, perspective_camera_is_centred_and_scaled_by_the_longer_side) {
  const PoseSet poses = read(file_of({reconstruction(kPerspective, {shot("a.jpg")})}));
  ASSERT_EQ(poses.images.size(), 1u);
  // f = 0.25 * 4000 px; normalised (0.1, 0), r^2 = 0.01: radial factor 0.99902. The middle of 4000 x 3000 pixels is
  // (2000, 1500) where the centre of the top-left one is (0.5, 0.5).
  expect_shown_at(poses.images[0], {105, 200, 0}, {2000 + 99.902, 1500});
  expect_shown_at(poses.images[0], {100, 205, 0}, {2000, 1500 - 99.902});
  EXPECT_EQ(poses.images[0].where, path("reconstruction.json") + ": shot 'a.jpg'");
}

TEST_F(OpenSfm, brown_camera_of_a_portrait_photograph) {
  const std::string brown =
      R"("c": {"projection_type": "brown", "width": 3000, "height": 4000, "focal_x": 0.25, "focal_y": 0.3, "c_x": 0.01,
         "c_y": -0.02, "k1": -0.1, "k2": 0.2, "p1": 0.01, "p2": 0.02, "k3": 0.3})";
  const PoseSet poses = read(file_of({reconstruction(brown, {shot("a.jpg")})}));
  // Normalised (0.1, 0): x' = 0.1 * 0.9990203 + p2 * 0.03, y' = p1 * 0.01; scale 4000.
  expect_shown_at(poses.images[0], {105, 200, 0},
                  {1500 + 40 + 1000 * (0.09990203 + 0.0006), 2000 - 80 + 1200 * 0.0001});
}

TEST_F(OpenSfm, rotation_is_an_angle_axis_from_world_to_camera) {
  // A quarter turn about z: the camera's x is the world's y, its y the world's -x.
  const std::string level = R"("rotation": [0, 0, -1.5707963267948966], "translation": [0, 0, 0])";
  const PoseSet poses = read(file_of(
      {reconstruction(kPerspective, {shot("a.jpg", "c", level),
                                     shot("b.jpg", "c", R"("rotation": [0, 0, 0], "translation": [1, 2, 3])")})}));
  const Mat3d& r = poses.images[0].pose.cam_from_world;
  EXPECT_NEAR(norm(r.row(0) - Vec3d{0, 1, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(r.row(1) - Vec3d{-1, 0, 0}), 0, 1e-15);
  EXPECT_EQ(poses.images[1].pose.cam_from_world, Mat3d{});
  EXPECT_EQ(poses.images[1].pose.center, (Vec3d{-1, -2, -3}));
}

TEST_F(OpenSfm, the_largest_of_several_reconstructions_is_read_and_the_others_are_noted) {
  const PoseSet poses =
      read(file_of({reconstruction(kPerspective, {shot("a")}), reconstruction(kPerspective, {shot("b"), shot("c")})}));
  ASSERT_EQ(poses.images.size(), 2u);
  EXPECT_EQ(poses.images[0].name, "b");
  ASSERT_EQ(poses.notes.size(), 1u);
  EXPECT_SENTENCE(poses.notes[0], "holds 2 reconstructions");
  EXPECT_SENTENCE(poses.notes[0], "1 shots of the others were left out");
}

TEST_F(OpenSfm, reference_point_is_noted_and_not_applied) {
  const PoseSet inside =
      read(file_of({reconstruction(kPerspective, {shot("a")}, R"(, "reference_lla": {"latitude": 46.8})")}));
  ASSERT_EQ(inside.notes.size(), 1u);
  EXPECT_SENTENCE(inside.notes[0], R"({"latitude":46.8} was not applied)");
  EXPECT_EQ(inside.images[0].pose.center, (Vec3d{100, 200, 50}));
  write("reference_lla.json", "{}");
  const PoseSet beside = read(file_of({reconstruction(kPerspective, {shot("a")})}));
  ASSERT_EQ(beside.notes.size(), 1u);
  EXPECT_SENTENCE(beside.notes[0], path("reference_lla.json"));
}

TEST_F(OpenSfm, points_are_passed_over) {
  const PoseSet poses =
      read(file_of({reconstruction(kPerspective, {shot("a")}, R"(, "points": {"1": {"coordinates": [1, 2, 3]}})")}));
  EXPECT_EQ(poses.images.size(), 1u);
}

TEST_F(OpenSfm, bad_shots_cost_only_themselves) {
  const std::string cameras = kPerspective + R"(, "eye": {"projection_type": "fisheye", "width": 1, "height": 1},
      "blind": {"projection_type": "perspective", "width": 10, "height": 10, "focal": "long"},
      "old": {"projection_type": "perspective", "width": 10, "height": 10}, "odd": 5, "flat": {"width": 0, "height": 1})";
  const PoseSet poses = read(file_of(
      {reconstruction(cameras, {shot("a"), shot("b", "none"), shot("c", "eye"), shot("d", "blind"), shot("e", "old"),
                                shot("f", "c", R"("rotation": [1, 2], "translation": [1, 2, 3])"),
                                shot("g", "c", R"("rotation": [1, 2, 3])"), R"("h": 5)", R"("i": {})", shot("j"),
                                shot("j"), shot("k", "odd"), shot("l", "flat")})}));
  ASSERT_EQ(poses.images.size(), 1u);
  EXPECT_EQ(poses.images[0].name, "a");
  const char* expected[] = {"shot 'b': its camera 'none' is not in the file",
                            "camera 'eye': the projection type \"fisheye\" is not supported",
                            "camera 'blind': 'focal' is not a number",
                            "camera 'old': has no 'focal'",
                            "shot 'f': 'rotation' is not a list of three numbers",
                            "shot 'g': 'translation' is not a list of three numbers",
                            "shot 'h': names no camera",
                            "shot 'i': names no camera",
                            "shot 'j': stands in the file more than once",
                            "camera 'odd': is not an object",
                            "camera 'flat': 'width' is no image size"};
  ASSERT_EQ(poses.refused.size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) EXPECT_SENTENCE(poses.refused[i].reason, expected[i]);
}

TEST_F(OpenSfm, a_shot_may_stand_in_two_reconstructions) {
  const PoseSet poses =
      read(file_of({reconstruction(kPerspective, {shot("a"), shot("b")}), reconstruction(kPerspective, {shot("a")})}));
  EXPECT_EQ(poses.images.size(), 2u);
  EXPECT_TRUE(poses.refused.empty());
}

TEST_F(OpenSfm, a_broken_file_is_refused_with_its_line) {
  EXPECT_SENTENCE(refusal("[\n{\"cameras\": }]"), "line 2");
  EXPECT_SENTENCE(refusal("[\n{\"cameras\": {}, \"shots\": {\"a\""), "is not valid JSON");
  EXPECT_SENTENCE(refusal("{}"), "is no OpenSfM reconstruction");
  EXPECT_SENTENCE(refusal("[]"), "is no OpenSfM reconstruction");
  EXPECT_SENTENCE(refusal("[{\"type\": \"FeatureCollection\"}]"), "is no OpenSfM reconstruction");
  EXPECT_SENTENCE(refusal(file_of({reconstruction(kPerspective, {})})), "holds no images");
}

}  // namespace
}  // namespace skysweep::formats
