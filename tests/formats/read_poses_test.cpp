// SPDX-License-Identifier: Apache-2.0
// Which format a path has, and what holds for every format.
#include <gtest/gtest.h>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

using ReadPoses = TestFolder;

const std::string kCsv =
    "image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height\ncsv.jpg,1,2,3,0,-90,0,1000,1000,1000,500,2000,1000\n";
const std::string kCameras = "1 PINHOLE 2000 1000 1000 1000 1000 500\n";
const std::string kImages = "1 1 0 0 0 0 0 0 1 colmap.jpg\n\n";
const std::string kJson =
    R"([{"cameras": {"c": {"width": 10, "height": 10, "focal": 1}},
         "shots": {"opensfm.jpg": {"camera": "c", "rotation": [0, 0, 0], "translation": [0, 0, 0]}}}])";

TEST_F(ReadPoses, a_file_is_known_by_its_name) {
  EXPECT_EQ(read_poses(write("flight.csv", kCsv)).images[0].name, "csv.jpg");
  EXPECT_EQ(read_poses(write("r.json", kJson)).images[0].name, "opensfm.jpg");
  write("m/cameras.txt", kCameras);
  EXPECT_EQ(read_poses(write("m/images.txt", kImages)).images[0].name, "colmap.jpg");
}

TEST_F(ReadPoses, a_file_is_known_by_its_content) {
  EXPECT_EQ(read_poses(write("flight.txt", "# ours\n" + kCsv)).images[0].name, "csv.jpg");
  EXPECT_EQ(read_poses(write("flight", kJson)).images[0].name, "opensfm.jpg");
}

TEST_F(ReadPoses, folders_of_colmap_odm_and_ours_are_opened) {
  write("a/sparse/0/cameras.txt", kCameras);
  write("a/sparse/0/images.txt", kImages);
  EXPECT_EQ(read_poses(path("a")).images[0].name, "colmap.jpg");
  EXPECT_EQ(read_poses(path("a/sparse")).images.size(), 1u);
  write("b/opensfm/reconstruction.json", kJson);
  EXPECT_EQ(read_poses(path("b")).images[0].name, "opensfm.jpg");
  write("c/poses.csv", kCsv);
  EXPECT_EQ(read_poses(path("c")).images[0].name, "csv.jpg");
}

TEST_F(ReadPoses, of_several_formats_in_a_folder_the_nearest_is_read_and_the_others_are_noted) {
  write("a/poses.csv", kCsv);
  write("a/sparse/cameras.txt", kCameras);
  write("a/sparse/images.txt", kImages);
  const PoseSet poses = read_poses(path("a"));
  EXPECT_EQ(poses.images[0].name, "csv.jpg");
  ASSERT_EQ(poses.notes.size(), 1u);
  EXPECT_SENTENCE(poses.notes[0], path("a/sparse") + ": was not read");
}

TEST_F(ReadPoses, what_is_no_pose_file_is_refused_with_what_would_be_accepted) {
  const auto refusal = [](const std::string& where) { return sentence_of([&] { read_poses(where); }); };
  EXPECT_SENTENCE(refusal(path("nowhere")), "there is no such file or folder of poses; accepted are a poses.csv");
  EXPECT_SENTENCE(refusal(folder_.string()), "no poses are in this folder; accepted are");
  EXPECT_SENTENCE(refusal(write("photo.jpg", std::string("\xFF\xD8\xFF\0\0,", 6))), "is no pose file; accepted are");
  EXPECT_SENTENCE(refusal(write("empty", "")), "is no pose file; accepted are");
  EXPECT_SENTENCE(refusal(std::string(5000, 'a')), "cannot be opened (File name too long)");
}

TEST_F(ReadPoses, origin_is_added_so_that_snapped_differences_to_it_are_the_positions_read) {
  PoseSet poses = read_poses(write("poses.csv", kCsv));
  const Vec3d origin{576700.1, 5188170, -0.3};
  add_origin(poses, origin);
  EXPECT_EQ(camera::snap_position(poses.images[0].pose.center - origin), (Vec3d{1, 2, 3}));
}

}  // namespace
}  // namespace skysweep::formats
