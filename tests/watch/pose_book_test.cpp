// SPDX-License-Identifier: Apache-2.0
#include "watch/pose_book.h"

#include <gtest/gtest.h>

#include "raster/temp_folder.h"

namespace skysweep::watch {
namespace {

using testing_support::put_bytes;
using Names = std::vector<std::string>;

const std::string kHeader = "image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height\n";
std::string line(const std::string& image, double x) {
  return image + "," + std::to_string(x) + ",0,50,0,-90,0,1000,1000,500,400,1000,800";
}

class PoseBookTest : public testing::Test {
 protected:
  void append(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary | std::ios::app) << text;
    book.arrived(name);
  }
  void put(const std::string& name, const std::string& text) {
    put_bytes(folder / name, text);
    book.arrived(name);
  }
  double x_of(const Pairing& pairing, const std::string& photograph) {
    const auto found = pairing.posed.find(photograph);
    return found == pairing.posed.end() ? -1 : found->second.pose.center.x;
  }

  testing_support::TempFolder folder;
  PoseBook book{folder.path(), std::nullopt};
};

TEST_F(PoseBookTest, photographs_wait_for_poses_and_poses_for_photographs) {
  Pairing pairing = book.pair({"a.jpg"});
  EXPECT_EQ(pairing.waiting, Names{"a.jpg"});
  append("poses.csv", kHeader + line("a.jpg", 1) + "\n" + line("b.jpg", 2) + "\n");
  EXPECT_TRUE(book.refresh(0, false));
  pairing = book.pair({"a.jpg"});
  EXPECT_EQ(x_of(pairing, "a.jpg"), 1);
  EXPECT_EQ(pairing.waiting, Names{});
  EXPECT_EQ(pairing.poses_waiting, 1u);
  EXPECT_EQ(x_of(book.pair({"a.jpg", "b.jpg"}), "b.jpg"), 2);
  EXPECT_FALSE(book.refresh(1, false)) << "nothing new";
}

TEST_F(PoseBookTest, a_line_that_has_not_ended_is_not_believed_until_the_file_stands_still) {
  append("poses.csv", kHeader + line("a.jpg", 1) + "\nb.jpg,2,0,50,0,-90,0,1000,1000,500,400,1000,8");
  book.refresh(0, false);
  EXPECT_EQ(book.pair({"a.jpg", "b.jpg"}).waiting, Names{"b.jpg"});
  append("poses.csv", "00\n" + line("c.jpg", 3));
  book.refresh(5, false);
  EXPECT_EQ(book.pair({"a.jpg", "b.jpg", "c.jpg"}).posed["b.jpg"].model.height_px, 800);
  EXPECT_EQ(book.pair({"c.jpg"}).waiting, Names{"c.jpg"});
  EXPECT_FALSE(book.refresh(14.9, false));
  EXPECT_TRUE(book.refresh(15, false)) << "ten seconds have passed";
  EXPECT_EQ(x_of(book.pair({"c.jpg"}), "c.jpg"), 3);
}

TEST_F(PoseBookTest, what_is_there_at_the_end_is_believed) {
  append("poses.csv", kHeader + line("a.jpg", 1));
  EXPECT_FALSE(book.refresh(0, false));
  EXPECT_TRUE(book.refresh(0, true));
  EXPECT_EQ(x_of(book.pair({"a.jpg"}), "a.jpg"), 1);
}

TEST_F(PoseBookTest, a_file_that_is_written_anew_does_not_take_poses_away) {
  put("poses.csv", kHeader + line("a.jpg", 1) + "\n" + line("b.jpg", 2) + "\n");
  book.refresh(0, false);
  put("poses.csv", kHeader + line("a.jpg", 7) + "\n");
  EXPECT_TRUE(book.refresh(1, false));
  const Pairing pairing = book.pair({"a.jpg", "b.jpg"});
  EXPECT_EQ(x_of(pairing, "a.jpg"), 7) << "a corrected pose is taken";
  EXPECT_EQ(x_of(pairing, "b.jpg"), 2);
  put("poses.csv", "");
  book.refresh(2, false);
  EXPECT_EQ(book.pair({"a.jpg", "b.jpg"}).posed.size(), 2u);
}

TEST_F(PoseBookTest, a_bad_line_costs_its_photograph_until_it_is_corrected) {
  put("poses.csv", kHeader + line("a.jpg", 1) + "\nb.jpg,nonsense,0,50,0,-90,0,1000,1000,500,400,1000,800\n");
  book.refresh(0, false);
  const Pairing pairing = book.pair({"a.jpg", "b.jpg"});
  EXPECT_EQ(x_of(pairing, "a.jpg"), 1);
  ASSERT_TRUE(pairing.refused.contains("b.jpg"));
  EXPECT_NE(pairing.refused.at("b.jpg").find("poses.csv:3"), std::string::npos) << pairing.refused.at("b.jpg");
  put("poses.csv", kHeader + line("a.jpg", 1) + "\n" + line("b.jpg", 2) + "\n");
  EXPECT_TRUE(book.refresh(1, false));
  EXPECT_EQ(x_of(book.pair({"a.jpg", "b.jpg"}), "b.jpg"), 2);
}

TEST_F(PoseBookTest, two_photographs_of_one_name_and_a_pose_without_folder_are_refused) {
  put("poses.csv", kHeader + line("a.jpg", 1) + "\n");
  book.refresh(0, false);
  const Pairing pairing = book.pair({"one/a.jpg", "two/a.jpg"});
  EXPECT_TRUE(pairing.posed.empty());
  EXPECT_EQ(pairing.refused.size(), 2u);
}

TEST_F(PoseBookTest, every_folder_may_have_poses_of_its_own) {
  put("poses.csv", kHeader + line("one/a.jpg", 1) + "\n" + line("two/a.jpg", 2) + "\n");
  put("two/poses.csv", kHeader + line("a.jpg", 22) + "\n");
  book.refresh(0, false);
  const Pairing pairing = book.pair({"one/a.jpg", "two/a.jpg"});
  EXPECT_EQ(x_of(pairing, "one/a.jpg"), 1);
  EXPECT_EQ(x_of(pairing, "two/a.jpg"), 22) << "the nearest file knows best";
}

TEST_F(PoseBookTest, a_file_beside_the_photograph_goes_before_the_table) {
  put("poses.csv", kHeader + line("one/a.jpg", 1) + "\n");
  put("one/a.json", R"({"x": 5, "y": 0, "z": 50, "yaw": 0, "pitch": -90, "roll": 0,
                        "fx": 1000, "fy": 1000, "cx": 500, "cy": 400, "width": 1000, "height": 800})");
  put("one/b.csv", kHeader + line("b.jpg", 6) + "\n");
  put("one/report.json", "{\"nothing\": \"of ours\"}");
  EXPECT_TRUE(book.refresh(0, false));
  Pairing pairing = book.pair({"one/a.jpg", "one/b.jpg"});
  EXPECT_EQ(x_of(pairing, "one/a.jpg"), 5);
  EXPECT_EQ(x_of(pairing, "one/b.jpg"), 6);
  EXPECT_EQ(pairing.posed["one/a.jpg"].name, "one/a.jpg");
  put("one/a.json", "{\"x\": 5,");
  book.refresh(1, false);
  pairing = book.pair({"one/a.jpg", "one/b.jpg"});
  ASSERT_TRUE(pairing.refused.contains("one/a.jpg"));
  EXPECT_NE(pairing.refused.at("one/a.jpg").find("a.json"), std::string::npos);
}

TEST_F(PoseBookTest, a_table_that_cannot_be_read_is_named_and_cameras_may_come_later) {
  put("poses.csv", "image,x,y,z,yaw,pitch,roll\na.jpg,1,0,50,0,-90,0\n");
  book.refresh(0, false);
  ASSERT_EQ(book.problems().size(), 1u);
  EXPECT_NE(book.problems().front().find("no camera"), std::string::npos) << book.problems().front();
  put("cameras.csv", "camera,fx,fy,cx,cy,width,height\nonly,1000,1000,500,400,1000,800\n");
  EXPECT_TRUE(book.refresh(1, false));
  EXPECT_TRUE(book.problems().empty());
  EXPECT_EQ(x_of(book.pair({"a.jpg"}), "a.jpg"), 1);
}

TEST_F(PoseBookTest, a_pose_file_elsewhere_takes_the_place_of_those_in_the_folder) {
  const testing_support::TempFolder& elsewhere = folder;
  put_bytes(elsewhere / "other.csv", kHeader + line("a.jpg", 9) + "\n");
  PoseBook given(folder / "images", folder / "other.csv");
  put_bytes(folder / "images/poses.csv", kHeader + line("a.jpg", 1) + "\n");
  given.arrived("poses.csv");
  given.refresh(0, false);
  EXPECT_EQ(x_of(given.pair({"a.jpg"}), "a.jpg"), 9);
}

}  // namespace
}  // namespace skysweep::watch
