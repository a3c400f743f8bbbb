// SPDX-License-Identifier: Apache-2.0
#include "raster/exr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

using testing_support::file_bytes;
using testing_support::message_of;
using testing_support::put_bytes;
using testing_support::TempFolder;

ExrImage some_image() {
  ExrImage image;
  for (const char* name : {"B", "G", "R"}) {
    Array2d<float>& values = image.channels[name] = Array2d<float>(37, 23);
    for (std::size_t i = 0; i < values.size(); ++i)
      values.data()[i] = static_cast<float>(name[0]) + 1e-6f * static_cast<float>(i * i);
  }
  image.labels = {{"content", "light"}, {"units", "white"}};
  return image;
}

TEST(Exr, channels_and_labels_read_back_bit_for_bit) {
  const TempFolder folder;
  const ExrImage image = some_image();
  write_exr(folder / "a.exr", image);
  const ExrImage read = read_exr(folder / "a.exr");
  EXPECT_EQ(read.channels, image.channels);
  EXPECT_EQ(read.labels.at("content"), "light");
  EXPECT_EQ(read.labels.at("units"), "white");
}

TEST(Exr, not_a_number_is_kept) {
  const TempFolder folder;
  ExrImage image;
  image.channels["Z"] = Array2d<float>(2, 1, std::numeric_limits<float>::quiet_NaN());
  write_exr(folder / "a.exr", image);
  EXPECT_TRUE(std::isnan(read_exr(folder / "a.exr").channels.at("Z")(1, 0)));
}

TEST(Exr, the_same_image_gives_the_same_bytes) {
  const TempFolder folder;
  write_exr(folder / "a.exr", some_image());
  write_exr(folder / "b.exr", some_image());
  EXPECT_EQ(file_bytes(folder / "a.exr"), file_bytes(folder / "b.exr"));
}

TEST(Exr, what_cannot_be_read_is_refused_by_name) {
  const TempFolder folder;
  EXPECT_NE(message_of<Error>([&] { read_exr(folder / "absent.exr"); }).find("absent.exr"), std::string::npos);
  write_exr(folder / "a.exr", some_image());
  put_bytes(folder / "cut.exr", file_bytes(folder / "a.exr").substr(0, 700));
  EXPECT_NE(message_of<Error>([&] { read_exr(folder / "cut.exr"); }).find("cut.exr"), std::string::npos);
  put_bytes(folder / "file/x", "");
  EXPECT_THROW(write_exr(folder / "file/x/a.exr", some_image()), Error);
}

}  // namespace
}  // namespace skysweep::raster
