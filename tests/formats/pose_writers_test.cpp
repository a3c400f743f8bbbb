// SPDX-License-Identifier: Apache-2.0
#include "formats/pose_writers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "formats/check_points.h"
#include "formats/files.h"

namespace skysweep::formats {
namespace {

using PoseWriters = TestFolder;

// Images of three cameras, anywhere in UTM-sized coordinates and turned anyhow, sorted by name.
std::vector<PosedImage> random_images() {
  Random random(2024);
  const auto distortion = [&] { return random.uniform(-0.1, 0.1); };
  std::vector<camera::CameraModel> models = {
      {4000, 3000, 3012.3456789012345, 3010.1, 1999.7, 1501.2, {}},
      {640, 480, 500.0 / 3, 500.0 / 7, 320, 240, {distortion(), distortion(), distortion(), distortion(), 0}},
      {640, 480, 600.1, 600.1, 320, 240, {distortion(), distortion(), distortion(), distortion(), distortion()}}};
  std::vector<PosedImage> images;
  for (int i = 0; i < 60; ++i) {
    const Mat3d rotation = camera::rotation_from_yaw_pitch_roll(random.uniform(-180, 180), random.uniform(-90, 90),
                                                                random.uniform(-180, 180));
    const Vec3d center =
        camera::snap_position({random.uniform(-1e7, 1e7), random.uniform(-1e7, 1e7), random.uniform(-100, 9000)});
    images.push_back({"flight " + std::to_string(i % 3) + "/IMG_" + std::to_string(100 + i) + ".jpg",
                      models[i % 3],
                      {rotation, center},
                      ""});
  }
  std::sort(images.begin(), images.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return images;
}

void expect_same(const PoseSet& read, const std::vector<PosedImage>& written) {
  EXPECT_TRUE(read.refused.empty());
  EXPECT_TRUE(read.notes.empty());
  ASSERT_EQ(read.images.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(read.images[i].name, written[i].name);
    EXPECT_EQ(read.images[i].model, written[i].model);
    EXPECT_EQ(read.images[i].pose.center, written[i].pose.center);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(read.images[i].pose.cam_from_world.m[k], written[i].pose.cam_from_world.m[k], 2e-15);
  }
}

TEST_F(PoseWriters, poses_csv_reads_back_the_same) {
  const auto images = random_images();
  write_poses_csv(path("poses.csv"), images);
  expect_same(read_poses(path("poses.csv")), images);
}

TEST_F(PoseWriters, colmap_model_reads_back_the_same) {
  const auto images = random_images();
  write_colmap_text(path("new/sparse"), images);
  expect_same(read_poses(path("new/sparse")), images);
}

TEST_F(PoseWriters, colmap_points_read_back_the_same) {
  write_colmap_text(path("sparse"), random_images(), {{{0.1, -1.0 / 3, 5e6}, {1, 2, 3}}, {{4, 5, 6}, {}}});
  const auto points = read_check_points(path("sparse"));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, (Vec3d{0.1, -1.0 / 3, 5e6}));
  EXPECT_EQ(points[1].id, "2");
}

// images.txt and points3D.txt name each other, as in "Output Format" of COLMAP's documentation.
TEST_F(PoseWriters, tracks_stand_at_images_and_at_points) {
  const auto images = random_images();
  write_colmap_text(
      path("sparse"), images,
      {{{1, 2, 3}, {}, {{0, {10.5, 20.25}}, {2, {30, 40}}}}, {{4, 5, 6}, {}, {{2, {7, 8}}}}, {{7, 8, 9}, {}}});
  const auto lines = [&](const std::string& file) {
    std::ifstream in(path("sparse/" + file));
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);)
      if (line.empty() || line[0] != '#') out.push_back(line);
    return out;
  };
  const auto at_images = lines("images.txt"), at_points = lines("points3D.txt");
  EXPECT_EQ(at_images[1], "10.5 20.25 1");
  EXPECT_EQ(at_images[3], "");
  EXPECT_EQ(at_images[5], "30 40 1 7 8 2");
  EXPECT_EQ(at_points[0], "1 1 2 3 0 0 0 0 1 0 3 0");
  EXPECT_EQ(at_points[1], "2 4 5 6 0 0 0 0 3 1");
  expect_same(read_poses(path("sparse")), images);
  EXPECT_EQ(read_check_points(path("sparse"), {2, {}}).size(), 1u);
}

TEST_F(PoseWriters, difficult_names_survive) {
  std::vector<PosedImage> images(4, random_images()[0]);
  images[0].name = " space before.jpg";
  images[1].name = "#1.jpg";
  images[2].name = "a \"quoted\" name.jpg";
  images[3].name = "a,b.jpg";
  write_poses_csv(path("poses.csv"), images);
  expect_same(read_poses(path("poses.csv")), images);
}

TEST_F(PoseWriters, names_that_a_format_cannot_hold_are_refused) {
  std::vector<PosedImage> images = {random_images()[0]};
  for (const char* name : {"", "two\nlines.jpg"}) {
    images[0].name = name;
    EXPECT_SENTENCE(sentence_of([&] { write_poses_csv(path("poses.csv"), images); }), "rename the photograph");
    EXPECT_SENTENCE(sentence_of([&] { write_colmap_text(path("sparse"), images); }), "rename the photograph");
  }
  images[0].name = "space after.jpg ";
  EXPECT_SENTENCE(sentence_of([&] { write_colmap_text(path("sparse"), images); }), "rename the photograph");
}

TEST_F(PoseWriters, a_place_that_cannot_be_written_is_named) {
  write("file", "");
  const auto images = random_images();
  EXPECT_SENTENCE(sentence_of([&] { write_poses_csv(path("no/such/poses.csv"), images); }, ErrorKind::failed),
                  path("no/such/poses.csv") + ": cannot be written (No such file");
  EXPECT_SENTENCE(sentence_of([&] { write_colmap_text(path("file/sparse"), images); }, ErrorKind::failed),
                  path("file/sparse") + ": the folder cannot be made");
}

}  // namespace
}  // namespace skysweep::formats
