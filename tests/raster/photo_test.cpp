// SPDX-License-Identifier: Apache-2.0
#include "raster/photo.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

constexpr int kWidth = 40, kHeight = 24;

// Smooth, so that JPEG keeps it within a few grey levels; left and right, top and bottom differ.
Array2d<Rgb8> ramp() {
  Array2d<Rgb8> image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      image(x, y) = {static_cast<std::uint8_t>(6 * x), static_cast<std::uint8_t>(10 * y), 128};
  return image;
}

int largest_difference(const Array2d<Rgb8>& a, const Array2d<Rgb8>& b) {
  if (a.width() != b.width() || a.height() != b.height()) return 256;
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb8 p = a.data()[i], q = b.data()[i];
    largest = std::max({largest, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
  }
  return largest;
}

std::string jpeg_bytes(const TempFolder& folder) {
  write_image(folder / "ramp.jpg", ramp());
  return file_bytes(folder / "ramp.jpg");
}

std::string refusal_of(const fs::path& path) {
  return message_of<Error>([&] { read_photo(path); });
}

// APP1 segment with an EXIF block whose only entry is the orientation (tag 0x0112, type SHORT).
std::string exif_orientation(char orientation) {
  using namespace std::string_literals;
  return "\xff\xe1\x00\x22"s + "Exif\0\0"s + "II*\0\x08\0\0\0"s + "\x01\0"s + "\x12\x01\x03\0\x01\0\0\0"s +
         orientation + "\0\0\0"s + "\0\0\0\0"s;
}

TEST(Photo, lossless_formats_come_back_exactly_and_jpeg_nearly) {
  const TempFolder folder;
  for (const char* name : {"a.png", "a.tif", "A.TIFF", "a.bmp"}) {
    write_image(folder / name, ramp());
    EXPECT_EQ(read_photo(folder / name), ramp()) << name;
    EXPECT_EQ(read_photo_size(folder / name).width_px, kWidth) << name;
    EXPECT_EQ(read_photo_size(folder / name).height_px, kHeight) << name;
  }
  write_image(folder / "a.jpg", ramp());
  EXPECT_LE(largest_difference(read_photo(folder / "a.jpg"), ramp()), 12);
  EXPECT_EQ(read_photo_size(folder / "a.jpg").width_px, kWidth);
}

TEST(Photo, exif_orientation_does_not_turn_the_pixels) {
  const TempFolder folder;
  const std::string plain = jpeg_bytes(folder);
  for (const char orientation : {3, 6, 8}) {
    put_bytes(folder / "turned.jpg", plain.substr(0, 2) + exif_orientation(orientation) + plain.substr(2));
    EXPECT_EQ(cv::imread((folder / "turned.jpg").string()).rows, orientation == 3 ? kHeight : kWidth)
        << "the test's own EXIF block is not understood";
    EXPECT_EQ(read_photo(folder / "turned.jpg"), read_photo(folder / "ramp.jpg"));
    EXPECT_EQ(read_photo_size(folder / "turned.jpg").width_px, kWidth);
  }
}

TEST(Photo, grey_and_16_bit_images_become_8_bit_colour) {
  const TempFolder folder;
  cv::Mat grey(kHeight, kWidth, CV_8U, cv::Scalar(77));
  cv::imwrite((folder / "grey.png").string(), grey);
  EXPECT_EQ(read_photo(folder / "grey.png")(3, 3), (Rgb8{77, 77, 77}));

  cv::Mat deep(kHeight, kWidth, CV_16UC3, cv::Scalar(0x0000, 0x8080, 0xffff));  // blue, green, red
  for (const char* name : {"deep.png", "deep.tif"}) {
    cv::imwrite((folder / name).string(), deep);
    EXPECT_EQ(read_photo(folder / name)(0, 0), (Rgb8{255, 128, 0})) << name;
  }
}

TEST(Photo, alpha_is_dropped) {
  const TempFolder folder;
  cv::imwrite((folder / "alpha.png").string(), cv::Mat(kHeight, kWidth, CV_8UC4, cv::Scalar(1, 2, 3, 0)));
  EXPECT_EQ(read_photo(folder / "alpha.png")(0, 0), (Rgb8{3, 2, 1}));
}

TEST(Photo, floating_point_image_is_refused) {
  const TempFolder folder;
  cv::imwrite((folder / "float.tif").string(), cv::Mat(kHeight, kWidth, CV_32FC3, cv::Scalar(0.5, 0.5, 0.5)));
  EXPECT_NE(refusal_of(folder / "float.tif").find("8 bits"), std::string::npos);
}

TEST(Photo, jpeg_cut_off_at_any_byte_is_refused_quietly_by_name) {
  const TempFolder folder;
  const std::string whole = jpeg_bytes(folder);
  testing::internal::CaptureStderr();
  for (std::size_t length = 1; length < whole.size(); length += 7) {
    put_bytes(folder / "torn.jpg", whole.substr(0, length));
    const std::string message = refusal_of(folder / "torn.jpg");
    EXPECT_NE(message.find("torn.jpg"), std::string::npos) << message;
  }
  put_bytes(folder / "whole.jpg", whole);
  EXPECT_NO_THROW(require_whole_photo(folder / "whole.jpg"));
  put_bytes(folder / "torn.jpg", whole.substr(0, whole.size() - 1));
  EXPECT_NE(refusal_of(folder / "torn.jpg").find("cut off"), std::string::npos);
  EXPECT_THROW(require_whole_photo(folder / "torn.jpg"), Error) << "without decoding";
  // A card reader that gives up often fills the rest with zeros.
  put_bytes(folder / "torn.jpg", whole.substr(0, whole.size() / 2) + std::string(whole.size() / 2, '\0'));
  EXPECT_NE(refusal_of(folder / "torn.jpg").find("cut off"), std::string::npos);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Photo, end_marker_inside_a_thumbnail_does_not_hide_that_the_rest_is_missing) {
  const TempFolder folder;
  const std::string whole = jpeg_bytes(folder);
  const std::size_t length = whole.size() + 2;
  const std::string thumbnail =
      std::string("\xff\xe2") + static_cast<char>(length >> 8) + static_cast<char>(length) + whole;
  put_bytes(folder / "torn.jpg", "\xff\xd8" + thumbnail + whole.substr(2, whole.size() / 2));
  EXPECT_NE(refusal_of(folder / "torn.jpg").find("cut off"), std::string::npos);
}

TEST(Photo, bytes_after_the_end_of_a_jpeg_do_no_harm) {
  const TempFolder folder;
  put_bytes(folder / "more.jpg", jpeg_bytes(folder) + std::string("maker's appendix \xff\xd8\xff\xe0"));
  EXPECT_EQ(read_photo(folder / "more.jpg"), read_photo(folder / "ramp.jpg"));
}

TEST(Photo, progressive_jpeg_and_restart_markers_are_complete) {
  const TempFolder folder;
  cv::Mat noise(240, 320, CV_8UC3);
  cv::randu(noise, 0, 256);
  cv::imwrite((folder / "p.jpg").string(), noise, {cv::IMWRITE_JPEG_PROGRESSIVE, 1, cv::IMWRITE_JPEG_RST_INTERVAL, 4});
  EXPECT_EQ(read_photo(folder / "p.jpg").width(), 320);
  cv::imwrite((folder / "r.jpg").string(), noise, {cv::IMWRITE_JPEG_RST_INTERVAL, 2});
  EXPECT_EQ(read_photo(folder / "r.jpg").height(), 240);
}

TEST(Photo, png_and_tiff_cut_off_are_refused_quietly) {
  const TempFolder folder;
  testing::internal::CaptureStderr();
  for (const char* name : {"a.png", "a.tif"}) {
    write_image(folder / name, ramp());
    const std::string whole = file_bytes(folder / name);
    for (std::size_t length = 1; length < whole.size(); length += whole.size() / 20) {
      put_bytes(folder / name, whole.substr(0, length));
      EXPECT_NE(refusal_of(folder / name).find(name), std::string::npos) << length;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Photo, empty_missing_and_other_files_are_refused_by_name) {
  const TempFolder folder;
  put_bytes(folder / "empty.jpg", "");
  put_bytes(folder / "text.jpg", "GPS log of the flight");
  EXPECT_NE(refusal_of(folder / "empty.jpg").find("empty.jpg is empty"), std::string::npos);
  EXPECT_NE(refusal_of(folder / "text.jpg").find("not an image"), std::string::npos);
  EXPECT_NE(refusal_of(folder / "missing.jpg").find("does not exist"), std::string::npos);
  EXPECT_NE(refusal_of(folder.path()).find(folder.path().string()), std::string::npos);
  EXPECT_THROW(read_photo_size(folder / "empty.jpg"), Error);
  EXPECT_THROW(read_photo_size(folder / "text.jpg"), Error);
  testing::internal::CaptureStderr();
  for (const char* start : {"RIFF", "BM", "\x89PNG\r\n\x1a\n", "II*", "\xff\xd8\xff"}) {
    put_bytes(folder / "stub", start);
    EXPECT_THROW(read_photo(folder / "stub"), Error) << start;
    EXPECT_THROW(read_photo_size(folder / "stub"), Error) << start;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Photo, formats_that_have_to_be_converted_are_refused_with_the_way_to_do_it) {
  using namespace std::string_literals;
  const TempFolder folder;
  put_bytes(folder / "phone.jpg", "\0\0\0\x18"s + "ftypheic" + std::string(100, '\0'));
  EXPECT_NE(refusal_of(folder / "phone.jpg").find("heif-convert"), std::string::npos);
  put_bytes(folder / "canon.cr3", "\0\0\0\x18"s + "ftypcrx " + std::string(100, '\0'));
  EXPECT_NE(refusal_of(folder / "canon.cr3").find("dcraw"), std::string::npos);
  // A raw file with a TIFF preview that a TIFF reader would take for the photograph.
  write_image(folder / "preview.tif", ramp());
  for (const char* name : {"a.DNG", "a.nef", "a.ARW", "a.cr2"}) {
    fs::copy_file(folder / "preview.tif", folder / name);
    EXPECT_NE(refusal_of(folder / name).find("dcraw"), std::string::npos) << name;
    EXPECT_THROW(read_photo_size(folder / name), Error) << name;
  }
}

TEST(Photo, image_is_not_written_to_a_name_that_says_no_format) {
  const TempFolder folder;
  EXPECT_THROW(write_image(folder / "image.xyz", ramp()), Error);
  EXPECT_THROW(write_image(folder / "image", ramp()), Error);
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(PhotoList, is_sorted_recursive_and_without_hidden_or_other_files) {
  const TempFolder folder;
  for (const char* name : {"b.JPG", "a.jpeg", "sub/c.png", "sub/deep/d.TiF", "sub.tif", "raw.DNG", "phone.HEIC",
                           "notes.txt", ".hidden.jpg", ".git/e.jpg", "sub/jpg"})
    put_bytes(folder / name, "x");
  fs::create_directories(folder / "folder.jpg");
  EXPECT_EQ(list_photos(folder.path()), (std::vector<std::string>{"a.jpeg", "b.JPG", "phone.HEIC", "raw.DNG", "sub.tif",
                                                                  "sub/c.png", "sub/deep/d.TiF"}));
  EXPECT_THROW(list_photos(folder / "missing"), Error);
  EXPECT_THROW(list_photos(folder / "a.jpeg"), Error);
}

}  // namespace
}  // namespace skysweep::raster
