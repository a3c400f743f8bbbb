// SPDX-License-Identifier: Apache-2.0
// A photograph that cannot be used costs itself only: it is named with its reason, and the others make the map.
#include <opencv2/imgcodecs.hpp>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

class BrokenPhotograph : public SimulatedFlight {
 protected:
  // 0002.jpg, or whatever it was renamed to, is refused with these words; the rest is used.
  void expect_refused(const std::string& name, const std::vector<std::string>& words, const Arguments& more = {}) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.err, {name}));
    EXPECT_TRUE(says(outcome.err, words));
    EXPECT_TRUE(says(outcome.out, {"1 of 6 photographs were refused"}));
    const nlohmann::json entry = image_in_report(project(), name);
    EXPECT_EQ(entry.at("status"), "refused");
    EXPECT_TRUE(says(entry.at("reason"), words));
    expect_map(project(), kPhotographs - 1);
  }

  void cut_in_half(const std::string& name) { fs::resize_file(photo(name), fs::file_size(photo(name)) / 2); }
};

TEST_F(BrokenPhotograph, truncated_jpeg) {
  cut_in_half("0002.jpg");
  expect_refused("0002.jpg", {"is cut off", "copy it from the camera again"});
}

TEST_F(BrokenPhotograph, truncated_jpeg_does_not_keep_the_ground_from_being_found) {
  cut_in_half("0002.jpg");
  Arguments arguments = run_arguments();
  std::erase(arguments, kHeights);
  const Outcome outcome = skysweep(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.err, {"0002.jpg", "is cut off"}));
  expect_map(project(), kPhotographs - 1);
}

TEST_F(BrokenPhotograph, truncated_jpeg_leaves_nothing_to_do_for_a_second_run) {
  cut_in_half("0002.jpg");
  EXPECT_EQ(run().exit_code, 0);
  const auto before = rasters_in(project());
  const Outcome again = run();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(says(again.err, {"0002.jpg", "is cut off"}));
  EXPECT_EQ(report_of(project()).at("tiles").at("computed"), 0);
  EXPECT_EQ(photographs_used(project()), kPhotographs - 1);
  EXPECT_TRUE(rasters_in(project()) == before);
}

TEST_F(BrokenPhotograph, repaired_photograph_is_used_by_the_next_run) {
  const std::string whole = file_bytes(photo("0002.jpg"));
  EXPECT_EQ(run({}, "undisturbed").exit_code, 0);
  cut_in_half("0002.jpg");
  EXPECT_EQ(run().exit_code, 0);
  put_bytes(photo("0002.jpg"), whole);
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(photographs_used(project()), kPhotographs);
  EXPECT_TRUE(rasters_in(project()) == rasters_in(project("undisturbed")));
}

TEST_F(BrokenPhotograph, file_without_a_byte) {
  put_bytes(photo("0002.jpg"), "");
  expect_refused("0002.jpg", {"is empty", "copy it from the camera again"});
}

TEST_F(BrokenPhotograph, text_that_is_called_jpg) {
  put_bytes(photo("0002.jpg"), "These are notes, not pixels.\n");
  expect_refused("0002.jpg", {"is not an image of a known kind"});
}

TEST_F(BrokenPhotograph, size_differs_from_the_camera) {
  const cv::Mat pixels = pixels_of("0002.jpg");
  cv::imwrite(photo("0002.jpg"), pixels(cv::Rect(0, 0, 300, 240)));
  expect_refused("0002.jpg",
                 {"300 x 240", "320 x 240", "poses.csv", "use the photographs the poses were computed from"});
}

TEST_F(BrokenPhotograph, heic_says_how_to_convert) {
  fs::remove(photo("0002.jpg"));
  put_bytes(photo("0002.heic"), std::string("\0\0\0\x18"
                                            "ftypheic\0\0\0\0mif1heic",
                                            24) +
                                    std::string(1000, 'x'));
  replace_in_poses("0002.jpg", "0002.heic");
  expect_refused("0002.heic", {"HEIF", "converted first", "heif-convert"});
}

TEST_F(BrokenPhotograph, dng_says_how_to_develop) {
  fs::remove(photo("0002.jpg"));
  put_bytes(photo("0002.DNG"), std::string("II*\0\x08\0\0\0", 8) + std::string(1000, 'x'));
  replace_in_poses("0002.jpg", "0002.DNG");
  expect_refused("0002.DNG", {"raw camera file", "developed first", "dcraw"});
}

TEST_F(BrokenPhotograph, one_name_in_two_folders_is_not_guessed) {
  fs::create_directories(images() / "east");
  fs::create_directories(images() / "west");
  fs::copy(photo("0002.jpg"), photo("east/0002.jpg"));
  fs::rename(photo("0002.jpg"), photo("west/0002.jpg"));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(
      says(outcome.err, {"east/0002.jpg", "west/0002.jpg", "share a file name", "relative to the image folder"}));
  expect_map(project(), kPhotographs - 1);
}

TEST_F(BrokenPhotograph, strict_ends_with_3_and_still_makes_the_map) {
  put_bytes(photo("0002.jpg"), "");
  EXPECT_EQ(run({"--strict"}).exit_code, 3);
  expect_map(project(), kPhotographs - 1);
  fs::remove(photo("0002.jpg"));
  EXPECT_EQ(run({"--strict"}).exit_code, 0) << "a photograph that is not there was not refused";
}

TEST_F(BrokenPhotograph, all_broken_is_bad_input) {
  for (int i = 1; i <= kPhotographs; ++i) put_bytes(photo("000" + std::to_string(i) + ".jpg"), "");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(says(outcome.err, {"None of the 6 photographs", "is empty"}));
}

TEST_F(BrokenPhotograph, only_one_left_is_bad_input) {
  for (int i = 2; i <= kPhotographs; ++i) fs::remove(photo("000" + std::to_string(i) + ".jpg"));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(says(outcome.err, {"Only one photograph", "at least two"}));
}

}  // namespace
}  // namespace skysweep::app_test
