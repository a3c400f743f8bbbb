// SPDX-License-Identifier: Apache-2.0
#include "formats/arriving_poses.h"

#include <gtest/gtest.h>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

using ArrivingPoses = TestFolder;

const std::string kHeader = "image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height\n";
const std::string kRow = ",100,200,50,10,-89,1,1000,1000,1000,500,2000,1000";
const std::string kObject =
    R"("x": 100, "y": 200, "z": 50, "yaw": 10, "pitch": -89, "roll": 1,
       "fx": 1000, "fy": 1000, "cx": 1000, "cy": 500, "width": 2000, "height": 1000})";

TEST_F(ArrivingPoses, half_a_line_is_left_alone) {
  EXPECT_TRUE(read_growing_poses(write("poses.csv", "")).images.empty());
  EXPECT_TRUE(read_growing_poses(write("poses.csv", "image,x,")).images.empty());
  EXPECT_TRUE(read_growing_poses(write("poses.csv", kHeader)).images.empty());
  EXPECT_TRUE(read_growing_poses(write("poses.csv", kHeader + "a.jpg" + kRow)).images.empty());
  const PoseSet poses = read_growing_poses(write("poses.csv", kHeader + "a.jpg" + kRow + "\nb.jpg" + kRow));
  ASSERT_EQ(poses.images.size(), 1u);
  EXPECT_EQ(poses.images[0].name, "a.jpg");
  EXPECT_TRUE(poses.refused.empty());
  EXPECT_EQ(
      read_growing_poses(write("poses.csv", kHeader + "a.jpg" + kRow + "\r\nb.jpg" + kRow + "\r\n")).images.size(), 2u);
}

TEST_F(ArrivingPoses, a_comment_without_end_hides_no_line) {
  EXPECT_EQ(read_growing_poses(write("poses.csv", kHeader + "a.jpg" + kRow + "\n# the en")).images.size(), 1u);
}

TEST_F(ArrivingPoses, beside_a_photograph_as_csv_and_as_json_say_the_same) {
  const PosedImage table = read_poses(write("poses.csv", kHeader + "a.jpg" + kRow + "\n")).images.front();
  for (const std::string& path :
       {write("one.csv", kHeader + "a.jpg" + kRow + "\n"), write("two.json", "{\"image\": \"a.jpg\"," + kObject),
        write("three.json", "{" + kObject),
        write("four.csv", kHeader.substr(6) + kRow.substr(1))}) {  // without the name
    const PosedImage image = read_pose_sidecar(path, "flight 1/a.jpg");
    EXPECT_EQ(image.name, "flight 1/a.jpg") << path;
    EXPECT_EQ(image.pose, table.pose) << path;
    EXPECT_EQ(image.model, table.model) << path;
  }
}

TEST_F(ArrivingPoses, beside_a_photograph_what_is_wrong_is_said) {
  const auto refusal = [&](const std::string& name, const std::string& content) {
    const std::string path = write(name, content);
    return sentence_of([&] { read_pose_sidecar(path, "a.jpg"); });
  };
  EXPECT_SENTENCE(refusal("a.json", "{\"x\": 100,"), "no JSON object");
  EXPECT_SENTENCE(refusal("a.json", "[1, 2]"), "no JSON object");
  EXPECT_SENTENCE(refusal("a.json", "{\"k1\": [1]," + kObject), "'k1' is neither a number nor a text");
  EXPECT_SENTENCE(refusal("a.json", "{\"image\": \"b.jpg\"," + kObject), "lies beside 'a.jpg'");
  EXPECT_SENTENCE(refusal("a.json", "{\"x\": 1, \"y\": 2}"), "'z'");
  EXPECT_SENTENCE(refusal("a.csv", kHeader), "holds 0 lines");
  EXPECT_SENTENCE(refusal("a.csv", kHeader + "a.jpg" + kRow + "\na.jpg" + kRow), "holds 2 lines");
  EXPECT_SENTENCE(refusal("a.csv", kHeader + "a.jpg,nonsense" + kRow.substr(4)), "nonsense");
}

}  // namespace
}  // namespace skysweep::formats
