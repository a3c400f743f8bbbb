// SPDX-License-Identifier: Apache-2.0
#include "raster/picture.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace skysweep::raster {
namespace {

TEST(Picture, png_bytes_hold_the_pixels_in_our_order_of_channels) {
  Array2d<Rgb8> image(3, 2, Rgb8{10, 20, 30});
  image(2, 1) = {200, 100, 50};
  const std::string bytes = png_bytes(image);
  const cv::Mat read = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(read.cols, 3);
  ASSERT_EQ(read.rows, 2);
  EXPECT_EQ(read.at<cv::Vec3b>(0, 0), cv::Vec3b(30, 20, 10));
  EXPECT_EQ(read.at<cv::Vec3b>(1, 2), cv::Vec3b(50, 100, 200));
}

TEST(Picture, text_stays_within_its_width_and_is_cut_off_at_the_image) {
  Array2d<Rgb8> image(120, 30, Rgb8{255, 255, 255});
  draw_text(image, 10, 20, "1.5 m", 11, {200, 0, 0});
  const int end = 10 + text_width_px("1.5 m", 11);
  int inked = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool ink = image(x, y).g < 128;
      inked += ink;
      if (ink) {
        EXPECT_GE(image(x, y).r, image(x, y).b) << "red text";
        EXPECT_TRUE(x >= 9 && x <= end + 1) << x;
      }
    }
  EXPECT_GT(inked, 20);
  draw_text(image, 110, 20, "far beyond the border", 11, {0, 0, 0});
}

}  // namespace
}  // namespace skysweep::raster
