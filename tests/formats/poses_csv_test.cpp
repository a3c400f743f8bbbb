// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

class PosesCsv : public TestFolder {
 protected:
  PoseSet read(const std::string& content) const { return read_poses(write("poses.csv", content)); }
  std::string refusal(const std::string& content) const {
    return sentence_of([&] { read(content); });
  }
};

// 1000 px focal length, 2000 x 1000 px.
const std::string kHeader = "image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height\n";
const std::string kCamera = ",1000,1000,1000,500,2000,1000\n";

// A nadir camera 50 m above (100, 200, 0): 5 m on the ground are 100 px.
TEST_F(PosesCsv, yaw_zero_has_north_at_the_top) {
  const PoseSet poses = read(kHeader + "a.jpg,100,200,50,0,-90,0" + kCamera);
  ASSERT_EQ(poses.images.size(), 1u);
  expect_shown_at(poses.images[0], {105, 200, 0}, {1100, 500});
  expect_shown_at(poses.images[0], {100, 205, 0}, {1000, 400});
}

TEST_F(PosesCsv, yaw_ninety_has_east_at_the_top) {
  const PoseSet poses = read(kHeader + "a.jpg,100,200,50,90,-90,0" + kCamera);
  expect_shown_at(poses.images[0], {105, 200, 0}, {1000, 400});
  expect_shown_at(poses.images[0], {100, 205, 0}, {900, 500});
}

TEST_F(PosesCsv, kappa_turns_the_photograph_counter_clockwise) {
  const PoseSet poses = read(
      "image,x,y,z,omega,phi,kappa,fx,fy,cx,cy,width,height\n"
      "a.jpg,100,200,50,0,0,0" +
      kCamera + "b.jpg,100,200,50,0,0,90" + kCamera);
  expect_shown_at(poses.images[0], {105, 200, 0}, {1100, 500});
  expect_shown_at(poses.images[0], {100, 205, 0}, {1000, 400});
  expect_shown_at(poses.images[1], {100, 205, 0}, {1100, 500});
  expect_shown_at(poses.images[1], {105, 200, 0}, {1000, 600});
}

TEST_F(PosesCsv, quaternion_leads_from_world_to_camera) {
  const PoseSet poses = read("image,x,y,z,qw,qx,qy,qz,fx,fy,cx,cy,width,height\na.jpg,100,200,50,0,1,0,0" + kCamera);
  expect_shown_at(poses.images[0], {105, 200, 0}, {1100, 500});
  expect_shown_at(poses.images[0], {100, 205, 0}, {1000, 400});
}

TEST_F(PosesCsv, camera_in_millimetres_looks_at_the_middle_unless_told_otherwise) {
  const std::string pose = "a.jpg,100,200,50,0,-90,0,";
  const std::string header = "image,x,y,z,yaw,pitch,roll,";
  const PoseSet plain = read(header + "focal_mm,sensor_width_mm,width,height\n" + pose + "10,20,2000,1000\n");
  expect_shown_at(plain.images[0], {105, 200, 0}, {1100, 500});
  const PoseSet full = read(header + "focal_mm,sensor_width_mm,sensor_height_mm,width,height,cx,cy\n" + pose +
                            "10,20,10.1,2000,1000,1003,498\n");
  expect_shown_at(full.images[0], {105, 200, 0}, {1103, 498});
  expect_shown_at(full.images[0], {100, 205, 0}, {1003, 498 - 100 / 1.01});
}

TEST_F(PosesCsv, distortion_is_brown_in_the_order_of_opencv) {
  const PoseSet poses = read(
      "image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height,k1,k2,p1,p2,k3\n"
      "a.jpg,0,0,10,0,-90,0,1000,1000,1000,500,2000,1000,-0.1,0.2,0.01,0.02,0.3\n");
  // Normalised (0.1, 0): r^2 = 0.01; x' = 0.1 (1 - 0.001 + 0.00002 + 0.0000003) + 0.02 * 0.03, y' = 0.01 * 0.01.
  expect_shown_at(poses.images[0], {1, 0, 0}, {1000 + 1000 * (0.1 * 0.9990203 + 0.0006), 500 + 1000 * 0.0001});
}

TEST_F(PosesCsv, positions_are_snapped) {
  const PoseSet poses = read(kHeader + "a.jpg,500000.1,5188165.1456,198.98,0,-90,0" + kCamera);
  EXPECT_EQ(poses.images[0].pose.center, camera::snap_position({500000.1, 5188165.1456, 198.98}));
}

TEST_F(PosesCsv, byte_order_mark_windows_line_ends_comments_spaces_and_quotes_are_understood) {
  const PoseSet poses = read(
      "\xEF\xBB\xBF# flown in May\r\n\r\n Image , X,Y,Z, yaw,pitch,roll,fx,fy,cx,cy,width,height\r\n"
      "  # a comment between\r\n"
      "\"with, comma and \"\"quote\"\".jpg\" , +1 ,2,3,0,-90,0,1000,1000,1000,500,2000,1000\r\n"
      " my photo.jpg ,1,2,3,0,-90,0,1000,1000,1000,500,2000,1000");
  ASSERT_EQ(poses.images.size(), 2u);
  EXPECT_EQ(poses.images[0].name, "my photo.jpg");
  EXPECT_EQ(poses.images[1].name, "with, comma and \"quote\".jpg");
  EXPECT_EQ(poses.images[1].where, path("poses.csv") + ":5");
  EXPECT_EQ(poses.images[1].pose.center, (Vec3d{1, 2, 3}));
  EXPECT_TRUE(poses.refused.empty());
  EXPECT_TRUE(poses.notes.empty());
}

TEST_F(PosesCsv, images_are_sorted_by_name) {
  const PoseSet poses =
      read(kHeader + "b,0,0,1,0,-90,0" + kCamera + "c,0,0,1,0,-90,0" + kCamera + "a,0,0,1,0,-90,0" + kCamera);
  ASSERT_EQ(poses.images.size(), 3u);
  EXPECT_EQ(poses.images[0].name + poses.images[1].name + poses.images[2].name, "abc");
}

TEST_F(PosesCsv, other_columns_are_ignored_with_one_note_that_lists_them) {
  const PoseSet poses = read(
      "gps_alt,image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height,date\n9,a.jpg,0,0,1,0,-90,0,1000,1000,1000,500,2000,"
      "1000,May\n");
  ASSERT_EQ(poses.notes.size(), 1u);
  EXPECT_SENTENCE(poses.notes[0], "'gps_alt' and 'date'");
  EXPECT_EQ(poses.images.size(), 1u);
}

TEST_F(PosesCsv, missing_columns_are_named_with_the_line_of_the_header) {
  const std::string sentence = refusal("# made by hand\nimage,x,yaw,pitch,roll,fx,fy,cx,cy,width,height\n");
  EXPECT_SENTENCE(sentence, path("poses.csv") + ":2: ");
  EXPECT_SENTENCE(sentence, "'y' and 'z'");
}

TEST_F(PosesCsv, rotation_must_be_given_once_and_whole) {
  EXPECT_SENTENCE(refusal("image,x,y,z,fx\n"), ":1: no columns for the rotation");
  EXPECT_SENTENCE(refusal("image,x,y,z,qw,qx,qz,fx\n"), "'qy'");
  EXPECT_SENTENCE(refusal("image,x,y,z,yaw,pitch,roll,omega,phi,kappa,fx\n"), "the rotation is given twice");
}

TEST_F(PosesCsv, camera_must_be_given_once_and_whole) {
  const std::string start = "image,x,y,z,yaw,pitch,roll,";
  EXPECT_SENTENCE(refusal(start + "fx,cx,cy,width,height\n"), "'fy'");
  EXPECT_SENTENCE(refusal(start + "focal_mm,width,height\n"), "'sensor_width_mm'");
  EXPECT_SENTENCE(refusal(start + "focal_mm,sensor_width_mm,fx,width,height\n"), "keep one of the two");
  EXPECT_SENTENCE(refusal(start + "date\n"), "no camera");
  EXPECT_SENTENCE(refusal(start + "fx,fx,fy,cx,cy,width,height\n"), "'fx' more than once");
}

TEST_F(PosesCsv, a_bad_row_costs_only_itself) {
  const PoseSet poses =
      read(kHeader + "good.jpg,0,0,1,0,-90,0" + kCamera + "nan.jpg,nan,0,1,0,-90,0" + kCamera +
           "word.jpg,0,12m,1,0,-90,0" + kCamera + "short.jpg,0,0,1\n" + ",0,0,1,0,-90,0" + kCamera +
           "blank.jpg,0,,1,0,-90,0" + kCamera + "size.jpg,0,0,1,0,-90,0,1000,1000,1000,500,0,1000\n" +
           "focal.jpg,0,0,1,0,-90,0,-1000,1000,1000,500,2000,1000\n" + "far.jpg,1e12,0,1,0,-90,0" + kCamera);
  ASSERT_EQ(poses.images.size(), 1u);
  EXPECT_EQ(poses.images[0].name, "good.jpg");
  ASSERT_EQ(poses.refused.size(), 8u);
  const auto reason = [&](const std::string& name) {
    for (const RefusedImage& image : poses.refused)
      if (image.name == name) return image.reason;
    return std::string("not refused");
  };
  EXPECT_SENTENCE(reason("nan.jpg"), path("poses.csv") + ":3: column 'x' holds 'nan'");
  EXPECT_SENTENCE(reason("word.jpg"), ":4: column 'y' holds '12m'");
  EXPECT_SENTENCE(reason("short.jpg"), ":5: has 4 fields where the header has 13");
  EXPECT_SENTENCE(reason(""), ":6: the image has no name");
  EXPECT_SENTENCE(reason("blank.jpg"), ":7: column 'y' holds ''");
  EXPECT_SENTENCE(reason("size.jpg"), ":8: column 'width' holds '0'");
  EXPECT_SENTENCE(reason("focal.jpg"), ":9: the camera cannot be used: the focal length");
  EXPECT_SENTENCE(reason("far.jpg"), ":10: the position lies more than");
}

TEST_F(PosesCsv, unusable_quaternion_is_refused) {
  const std::string sentence =
      refusal("image,x,y,z,qw,qx,qy,qz,fx,fy,cx,cy,width,height\na.jpg,0,0,1,0,0,0,0" + kCamera);
  EXPECT_SENTENCE(sentence, ":2: the quaternion");
  EXPECT_SENTENCE(sentence, "none of its 1 images can be used");
}

TEST_F(PosesCsv, a_name_met_twice_is_refused_wholly_and_both_lines_are_named) {
  const PoseSet poses = read(kHeader + "a.jpg,0,0,1,0,-90,0" + kCamera + "b.jpg,0,0,1,0,-90,0" + kCamera +
                             "a.jpg,5,0,1,0,-90,0" + kCamera);
  ASSERT_EQ(poses.images.size(), 1u);
  EXPECT_EQ(poses.images[0].name, "b.jpg");
  ASSERT_EQ(poses.refused.size(), 1u);
  EXPECT_EQ(poses.refused[0].name, "a.jpg");
  EXPECT_SENTENCE(poses.refused[0].reason, path("poses.csv") + ":2 and " + path("poses.csv") + ":4: ");
}

TEST_F(PosesCsv, pixels_that_are_not_square_are_refused) {
  const std::string sentence = refusal(
      "image,x,y,z,yaw,pitch,roll,focal_mm,sensor_width_mm,sensor_height_mm,width,height\n"
      "a.jpg,0,0,1,0,-90,0,8.8,13.2,8.8,5472,3078\n");
  EXPECT_SENTENCE(sentence, "leave out sensor_height_mm");
}

TEST_F(PosesCsv, a_broken_table_is_refused_with_its_line) {
  EXPECT_SENTENCE(refusal(""), "is empty");
  EXPECT_SENTENCE(refusal("# only a comment\n"), "is empty");
  EXPECT_SENTENCE(refusal(kHeader), "holds no images");
  EXPECT_SENTENCE(refusal("image;x;y;z\n"), ":1: the columns are not separated by commas");
  EXPECT_SENTENCE(refusal(kHeader + "\"a.jpg,0,0\n"), ":2: a double quote is opened");
  EXPECT_SENTENCE(refusal(kHeader + "\"a\"b,0,0\n"), ":2: text follows a closing double quote");
}

class CamerasCsv : public PosesCsv {
 protected:
  const std::string poses_ =
      "image,camera,x,y,z,yaw,pitch,roll\na.jpg,wide,100,200,50,0,-90,0\nb.jpg,tele,100,200,50,0,-90,0\n";
  const std::string header_ = "camera,fx,fy,cx,cy,width,height\n";
};

TEST_F(CamerasCsv, rows_name_their_camera) {
  write("cameras.csv", header_ + "wide,1000,1000,1000,500,2000,1000\ntele,2000,2000,1000,500,2000,1000\n");
  const PoseSet poses = read(poses_);
  expect_shown_at(image_named(poses, "a.jpg"), {105, 200, 0}, {1100, 500});
  expect_shown_at(image_named(poses, "b.jpg"), {105, 200, 0}, {1200, 500});
  EXPECT_TRUE(poses.notes.empty());
}

TEST_F(CamerasCsv, a_single_camera_needs_no_name) {
  write("cameras.csv", "focal_mm,sensor_width_mm,width,height\n10,20,2000,1000\n");
  const PoseSet poses = read("image,x,y,z,yaw,pitch,roll\na.jpg,100,200,50,0,-90,0\n");
  expect_shown_at(poses.images[0], {105, 200, 0}, {1100, 500});
}

TEST_F(CamerasCsv, an_unknown_camera_costs_the_images_that_name_it) {
  write("cameras.csv", header_ + "wide,1000,1000,1000,500,2000,1000\n");
  const PoseSet poses = read(poses_);
  EXPECT_EQ(poses.images.size(), 1u);
  ASSERT_EQ(poses.refused.size(), 1u);
  EXPECT_SENTENCE(poses.refused[0].reason, path("poses.csv") + ":3: camera 'tele' is not in " + path("cameras.csv"));
}

TEST_F(CamerasCsv, a_bad_camera_costs_the_images_that_name_it) {
  write("cameras.csv", header_ + "wide,1000,1000,1000,500,2000,1000\ntele,2000,oops,1000,500,2000,1000\n");
  const PoseSet poses = read(poses_);
  ASSERT_EQ(poses.refused.size(), 1u);
  EXPECT_SENTENCE(poses.refused[0].reason, path("cameras.csv") + ":3: column 'fy' holds 'oops'");
}

TEST_F(CamerasCsv, a_camera_defined_twice_costs_the_images_that_name_it) {
  write("cameras.csv", header_ + "wide,1,1,1,1,2,1\ntele,2000,2000,1000,500,2000,1000\nwide,1,1,1,1,2,1\n");
  const PoseSet poses = read(poses_);
  ASSERT_EQ(poses.refused.size(), 1u);
  EXPECT_EQ(poses.refused[0].name, "a.jpg");
  EXPECT_SENTENCE(poses.refused[0].reason, path("cameras.csv") + ":2 and " + path("cameras.csv") + ":4");
}

TEST_F(CamerasCsv, several_cameras_without_a_name_column_are_refused) {
  write("cameras.csv", header_ + "wide,1,1,1,1,2,1\ntele,1,1,1,1,2,1\n");
  EXPECT_SENTENCE(refusal("image,x,y,z,yaw,pitch,roll\na.jpg,0,0,1,0,-90,0\n"), "holds 2 cameras");
}

}  // namespace
}  // namespace skysweep::formats
