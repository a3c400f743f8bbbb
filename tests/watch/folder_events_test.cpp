// SPDX-License-Identifier: Apache-2.0
#include "watch/folder_events.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "raster/temp_folder.h"

namespace skysweep::watch {
namespace {

using Kind = FileEvent::Kind;
using testing_support::put_bytes;

bool tells(const std::vector<FileEvent>& events, Kind kind, const std::string& name) {
  return std::any_of(events.begin(), events.end(),
                     [&](const FileEvent& event) { return event.kind == kind && event.name == name; });
}

class FolderEventsTest : public testing::Test {
 protected:
  FolderEventsTest() : events(folder_events(folder.path())) {}
  void SetUp() override {
    if (!events) GTEST_SKIP() << "this machine gives no events (inotify)";
  }
  testing_support::TempFolder folder;
  std::unique_ptr<FolderEvents> events;
};

TEST_F(FolderEventsTest, a_file_is_told_when_it_is_closed) {
  std::ofstream file(folder / "a.jpg");
  file << "half" << std::flush;
  const auto before = events->wait(0);
  EXPECT_TRUE(tells(before, Kind::written, "a.jpg"));
  EXPECT_FALSE(tells(before, Kind::closed, "a.jpg"));
  file.close();
  EXPECT_TRUE(tells(events->wait(0), Kind::closed, "a.jpg"));
}

TEST_F(FolderEventsTest, a_file_renamed_or_linked_in_is_whole) {
  put_bytes(folder / "a.part", "bytes");
  std::filesystem::rename(folder / "a.part", folder / "a.jpg");
  std::filesystem::create_hard_link(folder / "a.jpg", folder / "b.jpg");
  std::filesystem::create_symlink(folder / "a.jpg", folder / "c.jpg");
  const auto told = events->wait(0);
  for (const char* name : {"a.jpg", "b.jpg", "c.jpg"}) EXPECT_TRUE(tells(told, Kind::closed, name)) << name;
  EXPECT_TRUE(tells(told, Kind::gone, "a.part"));
}

TEST_F(FolderEventsTest, new_subfolders_are_followed_and_asked_to_be_looked_at) {
  put_bytes(folder / "flight/deep/a.jpg", "there before anybody could watch");
  EXPECT_TRUE(tells(events->wait(0), Kind::lost, ""));
  put_bytes(folder / "flight/deep/b.jpg", "bytes");
  EXPECT_TRUE(tells(events->wait(0), Kind::closed, "flight/deep/b.jpg"));
  std::filesystem::remove(folder / "flight/deep/b.jpg");
  EXPECT_TRUE(tells(events->wait(0), Kind::gone, "flight/deep/b.jpg"));
}

TEST_F(FolderEventsTest, when_the_folder_goes_it_says_so) {
  EXPECT_TRUE(events->tells());
  std::filesystem::remove_all(folder.path());
  EXPECT_TRUE(tells(events->wait(0), Kind::lost, ""));
  EXPECT_FALSE(events->tells());
}

TEST(NoEvents, nothing_is_told) {
  EXPECT_TRUE(no_events()->wait(0).empty());
  EXPECT_FALSE(no_events()->tells());
  EXPECT_EQ(folder_events("/nonexistent/folder"), nullptr);
}

}  // namespace
}  // namespace skysweep::watch
