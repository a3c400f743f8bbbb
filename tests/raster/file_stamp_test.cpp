// SPDX-License-Identifier: Apache-2.0
#include "raster/file_stamp.h"

#include <gtest/gtest.h>

#include <chrono>

#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;
using std::chrono_literals::operator""h;

TEST(FileStamp, is_the_same_until_the_file_is_touched) {
  const TempFolder folder;
  const fs::path file = folder / "a";
  put_bytes(file, "one");
  const auto stamp = file_stamp(file);
  EXPECT_EQ(file_stamp(file), stamp);
  put_bytes(file, "three");
  EXPECT_NE(file_stamp(file), stamp);
  EXPECT_FALSE(file_stamp(folder / "none"));
  EXPECT_FALSE(file_stamp(folder.path()));
}

TEST(FileStamp, is_not_deceived_by_a_time_of_change_that_was_set_back) {
  const TempFolder folder;
  const fs::path file = folder / "a", other = folder / "b";
  put_bytes(file, "one");
  put_bytes(other, "two");
  const auto stamp = file_stamp(file);
  const auto time = fs::last_write_time(file);
  fs::rename(other, file);
  fs::last_write_time(file, time);
  EXPECT_NE(file_stamp(file), stamp);
}

TEST(FileStamp, of_a_file_that_was_just_changed_is_not_relied_on) {
  const TempFolder folder;
  const fs::path file = folder / "a";
  put_bytes(file, "one");
  EXPECT_EQ(settled_file_stamp(file), "");
  fs::last_write_time(file, fs::file_time_type::clock::now() - 1h);
  EXPECT_EQ(settled_file_stamp(file), "") << "the entry was changed just now";
  fs::last_write_time(file, fs::file_time_type::clock::now() + 1h);
  EXPECT_EQ(settled_file_stamp(file), "") << "the clock was set back since";
  EXPECT_EQ(settled_file_stamp(folder / "none"), "");
  EXPECT_NE(settled_file_stamp("/bin/sh"), "");
}

}  // namespace
}  // namespace skysweep::raster
