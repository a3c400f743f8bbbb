// SPDX-License-Identifier: Apache-2.0
// Photographs that are out of the ordinary, and used.
#include <opencv2/imgcodecs.hpp>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

class UnusualPhotograph : public SimulatedFlight {
 protected:
  void expect_all_used() {
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    expect_map(project(), kPhotographs);
  }

  // Run before the photographs are changed: the heights to compare with.
  Array2d<float> undisturbed_heights() {
    EXPECT_EQ(run({}, "undisturbed").exit_code, 0);
    return heights_in(project("undisturbed") / "dsm.tif");
  }
};

TEST_F(UnusualPhotograph, sixteen_bit_tiff_gives_the_heights_of_its_eight_bits) {
  const Array2d<float> expected = undisturbed_heights();
  cv::Mat deep;
  pixels_of("0002.jpg").convertTo(deep, CV_16U, 257);
  fs::remove(photo("0002.jpg"));
  ASSERT_TRUE(cv::imwrite(photo("0002.tif"), deep));
  replace_in_poses("0002.jpg", "0002.tif");
  expect_all_used();
  EXPECT_TRUE(same_bits(heights_in(project() / "dsm.tif"), expected));
}

TEST_F(UnusualPhotograph, grey_photograph) {
  const cv::Mat grey = cv::imread(photo("0002.jpg"), cv::IMREAD_GRAYSCALE);
  ASSERT_TRUE(cv::imwrite(photo("0002.jpg"), grey));
  expect_all_used();
}

TEST_F(UnusualPhotograph, exif_rotation_is_not_applied) {
  const Array2d<float> expected = undisturbed_heights();
  // APP1 with one entry of IFD0, little-endian: Orientation (0x0112), SHORT, 6 = turn by 90 degrees for display.
  using namespace std::string_literals;
  const std::string tiff = "II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"s;
  const std::string exif = "Exif\0\0"s + tiff;
  const std::string marker = {'\xff', '\xe1', '\0', static_cast<char>(exif.size() + 2)};
  const std::string jpeg = file_bytes(photo("0002.jpg"));
  put_bytes(photo("0002.jpg"), jpeg.substr(0, 2) + marker + exif + jpeg.substr(2));
  ASSERT_EQ(cv::imread(photo("0002.jpg")).rows, 320) << "viewers must turn the photograph, or this tests nothing";
  expect_all_used();
  EXPECT_TRUE(same_bits(heights_in(project() / "dsm.tif"), expected));
}

TEST_F(UnusualPhotograph, subfolders_are_read) {
  const Array2d<float> expected = undisturbed_heights();
  fs::create_directories(images() / "flight 1" / "east");
  fs::rename(photo("0005.jpg"), photo("flight 1/east/0005.jpg"));
  fs::rename(photo("0006.jpg"), photo("flight 1/0006.jpg"));
  expect_all_used();
  EXPECT_EQ(heights_in(project() / "dsm.tif").size(), expected.size());
}

TEST_F(UnusualPhotograph, one_name_in_two_folders_is_told_apart_by_paths_in_the_pose_file) {
  fs::create_directories(images() / "east");
  fs::create_directories(images() / "west");
  fs::rename(photo("0002.jpg"), photo("east/photo.jpg"));
  fs::rename(photo("0003.jpg"), photo("west/photo.jpg"));
  replace_in_poses("0002.jpg", "east/photo.jpg");
  replace_in_poses("0003.jpg", "west/photo.jpg");
  expect_all_used();
}

}  // namespace
}  // namespace skysweep::app_test
