// SPDX-License-Identifier: Apache-2.0
#include "formats/time_taken.h"

#include <gtest/gtest.h>

#include <exiv2/exiv2.hpp>

#include "formats/files.h"

namespace skysweep::formats {
namespace {

using TimeTaken = TestFolder;
using namespace std::chrono_literals;

// A grey PNG of one pixel.
std::string tiny_png() {
  const unsigned char bytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
                                 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00,
                                 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00, 0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78,
                                 0x9c, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81, 0x77, 0xcd, 0x72, 0xb6, 0x00,
                                 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

// It with the tags that are not empty.
std::string photo_with(const std::string& path, const std::string& original, const std::string& fraction = "",
                       const std::string& offset = "") {
  std::ofstream(path, std::ios::binary) << tiny_png();
  const auto image = Exiv2::ImageFactory::open(path);
  image->readMetadata();
  if (!original.empty()) image->exifData()["Exif.Photo.DateTimeOriginal"] = original;
  if (!fraction.empty()) image->exifData()["Exif.Photo.SubSecTimeOriginal"] = fraction;
  if (!offset.empty()) image->exifData()["Exif.Photo.OffsetTimeOriginal"] = offset;
  image->writeMetadata();
  return path;
}

constexpr auto kMidsummer = std::chrono::sys_days{std::chrono::year{2026} / 6 / 21};

TEST_F(TimeTaken, is_read_with_fraction_and_offset) {
  EXPECT_EQ(time_taken(photo_with(path("a.png"), "2026:06:21 12:30:05")), kMidsummer + 12h + 30min + 5s);
  EXPECT_EQ(time_taken(photo_with(path("b.png"), "2026:06:21 12:30:05", "25")), kMidsummer + 12h + 30min + 5s + 250ms);
  EXPECT_EQ(time_taken(photo_with(path("c.png"), "2026:06:21 01:30:05", "", "+02:00")), kMidsummer - 30min + 5s);
  EXPECT_EQ(time_taken(photo_with(path("d.png"), "2026:06:21 01:30:05", "", "-03:30")), kMidsummer + 5h + 5s);
}

TEST_F(TimeTaken, is_not_guessed) {
  EXPECT_FALSE(time_taken(photo_with(path("a.png"), "")).has_value());
  EXPECT_FALSE(time_taken(photo_with(path("b.png"), "0000:00:00 00:00:00")).has_value());
  EXPECT_FALSE(time_taken(write("text.jpg", "no photograph")).has_value());
  EXPECT_FALSE(time_taken(path("missing.jpg")).has_value());
}

}  // namespace
}  // namespace skysweep::formats
