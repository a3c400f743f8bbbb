// SPDX-License-Identifier: Apache-2.0
#include "formats/check_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/colmap_samples.h"
#include "formats/files.h"

namespace skysweep::formats {
namespace {

class CheckPoints : public TestFolder {
 protected:
  std::string refusal(const std::string& name, const std::string& content) const {
    return sentence_of([&] { read_check_points(write(name, content)); });
  }
};

const std::string kModel =
    "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]\n"
    "5 1 2 3 10 20 30 0.25 1 0 2 0 3 0\n"
    "7 4.5 5.5 6.5 10 20 30 1.5 1 1 2 1 3 1\n"
    "9 7 8 9 10 20 30 0.5 1 2 2 2\n"
    "11 0 0 0 0 0 0 -1\n";

std::string binary_model() {
  Bytes file;
  file.add(std::uint64_t{4});
  add_point(file, 5, {1, 2, 3}, 0.25, 3);
  add_point(file, 7, {4.5, 5.5, 6.5}, 1.5, 3);
  add_point(file, 9, {7, 8, 9}, 0.5, 2);
  add_point(file, 11, {0, 0, 0}, -1, 0);
  return file.text();
}

TEST_F(CheckPoints, table_gives_positions_and_names) {
  const auto points =
      read_check_points(write("p.csv", "ID,x,y,z,note\nA 1,1,2,3,x\n\"B,2\",4,5,6.5,y\n"), {}, {100, 200, 0.5});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].id, "A 1");
  EXPECT_EQ(points[1].id, "B,2");
  EXPECT_EQ(points[1].position, (Vec3d{104, 205, 7}));
  EXPECT_EQ(read_check_points(write("q.csv", "x,y,z\n1,2,3\n"))[0].id, "");
}

TEST_F(CheckPoints, a_bad_table_is_refused_with_its_line) {
  EXPECT_SENTENCE(refusal("p.csv", "x,y\n1,2\n"), path("p.csv") + ":1: the column(s) 'z'");
  EXPECT_SENTENCE(refusal("p.csv", "x,y,z\n1,2,3\n1,nan,3\n"), ":3: column 'y' holds 'nan'");
  EXPECT_SENTENCE(refusal("p.csv", "x,y,z\n1,2\n"), ":2: has 2 fields");
  EXPECT_SENTENCE(sentence_of([&] { read_check_points(path("nowhere.csv")); }), "there is no such file");
}

TEST_F(CheckPoints, filters_are_refused_for_a_table) {
  const std::string table = write("p.csv", "x,y,z\n1,2,3\n");
  EXPECT_SENTENCE(
      sentence_of([&] { read_check_points(table, {.min_track_length = 3, .max_reprojection_error_px = {}}); },
                  ErrorKind::usage),
      "leave the filter out");
}

TEST_F(CheckPoints, text_and_binary_model_give_the_same_filtered_points) {
  write("text/points3D.txt", kModel);
  write("binary/sparse/0/points3D.bin", binary_model());
  for (const char* folder : {"text", "binary"}) {
    EXPECT_EQ(read_check_points(path(folder)).size(), 4u);
    const auto points =
        read_check_points(path(folder), {.min_track_length = 3, .max_reprojection_error_px = 1.5}, {10, 0, 0});
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].id, "5");
    EXPECT_EQ(points[0].position, (Vec3d{11, 2, 3}));
    EXPECT_EQ(points[1].position, (Vec3d{14.5, 5.5, 6.5}));
    EXPECT_EQ(read_check_points(path(folder), {.min_track_length = 3, .max_reprojection_error_px = 1.0}).size(), 1u);
    EXPECT_EQ(read_check_points(path(folder), {.min_track_length = 2, .max_reprojection_error_px = {}}).size(), 3u);
  }
  EXPECT_EQ(read_check_points(path("text/points3D.txt")).size(), 4u);
}

TEST_F(CheckPoints, a_broken_model_is_refused_with_its_place) {
  EXPECT_SENTENCE(refusal("points3D.txt", "1 2 3\n"), "points3D.txt:1: a point line reads");
  EXPECT_SENTENCE(refusal("points3D.txt", "\n1 2 3 nan 0 0 0 1\n"), "points3D.txt:2: 'nan' is not a finite number");
  const std::string whole = binary_model();
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_SENTENCE(refusal("points3D.bin", whole.substr(0, length)), "truncated");
  Bytes file;
  add_point(file.add(std::uint64_t{1}), 5, {NAN, 2, 3}, 0.25, 0);
  EXPECT_SENTENCE(refusal("points3D.bin", file.text()), "point 1: its position or error is not a finite number");
  std::filesystem::create_directories(path("empty"));
  EXPECT_SENTENCE(sentence_of([&] { read_check_points(path("empty")); }), "no points3D.txt or points3D.bin");
}

}  // namespace
}  // namespace skysweep::formats
