// SPDX-License-Identifier: Apache-2.0
#include "formats/gcp_list.h"

#include <gtest/gtest.h>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

using GcpLists = TestFolder;

TEST_F(GcpLists, read_back_the_same) {
  GcpList list{"EPSG:32632",
               {{"a", {691000.125, 5334000.1, 512.3}, {{"0001.jpg", {0.5, 0.5}}, {"0002.jpg", {100.25, 7.1}}}},
                {"b", {691010, 5334000, 511}, {{"0002.jpg", {3, 4}}}}}};
  write_gcp_list(path("gcp_list.txt"), list);
  const GcpList read = read_gcp_list(path("gcp_list.txt"));
  EXPECT_EQ(read.crs, list.crs);
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[0].name, "a");
  EXPECT_EQ(read.points[0].position, list.points[0].position);
  ASSERT_EQ(read.points[0].sightings.size(), 2u);
  EXPECT_EQ(read.points[0].sightings[1].image, "0002.jpg");
  EXPECT_NEAR(read.points[0].sightings[1].pixel.x, 100.25, 1e-12);
}

TEST_F(GcpLists, count_pixels_from_the_centre_of_the_first) {
  write_gcp_list(path("gcp_list.txt"), {"EPSG:32632", {{"a", {1, 2, 3}, {{"x.jpg", {0.5, 10.5}}}}}});
  std::ifstream file(path("gcp_list.txt"));
  std::string crs, line;
  std::getline(file, crs);
  std::getline(file, line);
  EXPECT_EQ(crs, "EPSG:32632");
  EXPECT_EQ(line, "1 2 3 0 10 x.jpg a");
}

TEST_F(GcpLists, of_other_programs_may_leave_names_out) {
  const GcpList read = read_gcp_list(
      write("gcp_list.txt", "WGS84 UTM 32N\n# comment\n1 2 3 10 20 a.jpg\n1 2 3 11 21 b.jpg\n4 5 6 1 1 a.jpg\n"));
  EXPECT_EQ(read.crs, "WGS84 UTM 32N");
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[0].sightings.size(), 2u);
}

TEST_F(GcpLists, that_are_broken_are_refused_with_the_line) {
  EXPECT_SENTENCE(sentence_of([&] { read_gcp_list(write("a", "EPSG:1\n1 2 3 4\n")); }), path("a") + ":2");
  EXPECT_SENTENCE(sentence_of([&] { read_gcp_list(write("b", "EPSG:1\n1 x 3 4 5 a.jpg\n")); }), "'x' is not a finite");
  EXPECT_SENTENCE(sentence_of([&] { read_gcp_list(write("c", "\n")); }), "reference system");
  EXPECT_SENTENCE(sentence_of([&] { write_gcp_list(path("d"), {"EPSG:1", {{"a b", {}, {{"x", {}}}}}}); }), "'a b'");
}

}  // namespace
}  // namespace skysweep::formats
