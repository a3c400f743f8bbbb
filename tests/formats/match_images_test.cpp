// SPDX-License-Identifier: Apache-2.0
#include "formats/match_images.h"

#include <gtest/gtest.h>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

PoseSet poses_named(const std::vector<std::string>& names) {
  PoseSet poses;
  for (const std::string& name : names)
    poses.images.push_back({name, {}, {}, "poses.csv:" + std::to_string(poses.images.size() + 2)});
  return poses;
}

// "photo=pose photo=pose"
std::string pairs(const ImageMatches& result, const PoseSet& poses) {
  std::string text;
  for (const ImageMatch& match : result.matches) text += match.photo + "=" + poses.images[match.pose].name + " ";
  return text;
}

TEST(MatchImages, exact_relative_path_comes_first) {
  const PoseSet poses = poses_named({"a/1.jpg", "b/1.jpg"});
  const ImageMatches result = match_images({"b/1.jpg", "a/1.jpg"}, poses);
  EXPECT_EQ(pairs(result, poses), "a/1.jpg=a/1.jpg b/1.jpg=b/1.jpg ");
  EXPECT_TRUE(result.notes.empty() && result.photos_without_pose.empty() && result.poses_without_photo.empty());
}

TEST(MatchImages, a_unique_file_name_is_enough) {
  const PoseSet poses = poses_named({"1.jpg", "/data/images/2.jpg", ".\\sub\\3.jpg"});
  const ImageMatches result = match_images({"sub/1.jpg", "2.jpg", "sub/3.jpg"}, poses);
  EXPECT_EQ(pairs(result, poses), "2.jpg=/data/images/2.jpg sub/1.jpg=1.jpg sub/3.jpg=.\\sub\\3.jpg ");
  EXPECT_TRUE(result.notes.empty());
}

TEST(MatchImages, folders_that_differ_are_noted) {
  const PoseSet poses = poses_named({"monday/1.jpg"});
  const ImageMatches result = match_images({"tuesday/1.jpg"}, poses);
  EXPECT_EQ(result.matches.size(), 1u);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_SENTENCE(result.notes[0], "'tuesday/1.jpg' with 'monday/1.jpg'");
}

TEST(MatchImages, case_is_disregarded_last_and_noted) {
  const PoseSet poses = poses_named({"1.jpg", "2.jpg"});
  const ImageMatches result = match_images({"1.JPG", "2.jpg"}, poses);
  EXPECT_EQ(pairs(result, poses), "1.JPG=1.jpg 2.jpg=2.jpg ");
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_SENTENCE(result.notes[0],
                  "1 photograph(s) were paired with their poses without regard to upper and lower case");
}

TEST(MatchImages, two_photographs_of_one_name_and_a_bare_pose_are_all_refused) {
  const PoseSet poses = poses_named({"1.jpg", "2.jpg"});
  const ImageMatches result = match_images({"a/1.jpg", "b/1.jpg", "a/2.jpg"}, poses);
  EXPECT_EQ(pairs(result, poses), "a/2.jpg=2.jpg ");
  ASSERT_EQ(result.photos_without_pose.size(), 2u);
  ASSERT_EQ(result.poses_without_photo.size(), 1u);
  for (const std::string& sentence : {result.photos_without_pose[0].reason, result.photos_without_pose[1].reason,
                                      result.poses_without_photo[0].reason}) {
    EXPECT_SENTENCE(sentence, "'a/1.jpg', 'b/1.jpg'");
    EXPECT_SENTENCE(sentence, "paths relative to the image folder");
  }
}

TEST(MatchImages, elimination_is_no_proof) {
  const PoseSet poses = poses_named({"1.jpg", "a/1.jpg"});
  const ImageMatches result = match_images({"a/1.jpg", "b/1.jpg"}, poses);
  EXPECT_EQ(pairs(result, poses), "a/1.jpg=a/1.jpg ");
  ASSERT_EQ(result.photos_without_pose.size(), 1u);
  EXPECT_EQ(result.photos_without_pose[0].name, "b/1.jpg");
}

TEST(MatchImages, two_poses_for_one_photograph_are_refused) {
  const PoseSet poses = poses_named({"a/1.jpg", "b/1.jpg"});
  const ImageMatches result = match_images({"1.jpg"}, poses);
  EXPECT_TRUE(result.matches.empty());
  EXPECT_EQ(result.poses_without_photo.size(), 2u);
}

TEST(MatchImages, what_has_no_partner_is_named) {
  const PoseSet poses = poses_named({"1.jpg", "3.jpg"});
  const ImageMatches result = match_images({"1.jpg", "2.jpg"}, poses);
  ASSERT_EQ(result.photos_without_pose.size(), 1u);
  EXPECT_EQ(result.photos_without_pose[0].name, "2.jpg");
  EXPECT_SENTENCE(result.photos_without_pose[0].reason, "no pose for '2.jpg'");
  ASSERT_EQ(result.poses_without_photo.size(), 1u);
  EXPECT_EQ(result.poses_without_photo[0].name, "3.jpg");
  EXPECT_SENTENCE(result.poses_without_photo[0].reason, "poses.csv:3: there is no photograph '3.jpg'");
}

TEST(MatchImages, a_photograph_whose_pose_was_refused_says_why_and_takes_no_other) {
  PoseSet poses = poses_named({"b/1.jpg"});
  poses.refused.push_back({"a/1.jpg", "poses.csv:9: the quaternion."});
  const ImageMatches result = match_images({"a/1.jpg"}, poses);
  ASSERT_EQ(result.photos_without_pose.size(), 1u);
  EXPECT_EQ(result.photos_without_pose[0].reason, "poses.csv:9: the quaternion.");
  EXPECT_EQ(result.poses_without_photo.size(), 1u);
}

TEST(MatchImages, the_order_of_the_photographs_changes_nothing) {
  const PoseSet poses = poses_named({"1.jpg", "2.JPG", "x/3.jpg"});
  const ImageMatches forwards = match_images({"1.jpg", "2.jpg", "3.jpg", "y/1.jpg"}, poses);
  const ImageMatches backwards = match_images({"y/1.jpg", "3.jpg", "2.jpg", "1.jpg"}, poses);
  EXPECT_EQ(pairs(forwards, poses), pairs(backwards, poses));
  EXPECT_EQ(forwards.notes, backwards.notes);
}

}  // namespace
}  // namespace skysweep::formats
