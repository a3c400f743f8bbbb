// SPDX-License-Identifier: Apache-2.0
#include "watch/arrivals.h"

#include <gtest/gtest.h>

#include "raster/temp_folder.h"
#include "watch/file_kind.h"

namespace skysweep::watch {
namespace {

using Names = std::vector<std::string>;

TEST(Arrivals, a_file_is_complete_when_it_is_closed_and_not_before) {
  Arrivals arrivals;
  arrivals.written("a.jpg");
  EXPECT_EQ(arrivals.take_changes().complete, Names{});
  EXPECT_EQ(arrivals.unsettled(), 1);
  arrivals.closed("a.jpg", "stamp");
  EXPECT_EQ(arrivals.take_changes().complete, Names{"a.jpg"});
  EXPECT_EQ(arrivals.unsettled(), 0);
}

TEST(Arrivals, a_file_is_complete_when_two_looks_found_it_the_same) {
  Arrivals arrivals;
  arrivals.look({{"a.jpg", "100 bytes"}});
  arrivals.look({{"a.jpg", "200 bytes"}});
  EXPECT_EQ(arrivals.take_changes().complete, Names{});
  arrivals.look({{"a.jpg", "200 bytes"}});
  EXPECT_EQ(arrivals.take_changes().complete, Names{"a.jpg"});
  arrivals.look({{"a.jpg", "200 bytes"}});
  EXPECT_EQ(arrivals.take_changes().complete, Names{}) << "once is enough";
}

TEST(Arrivals, what_changes_again_is_complete_again) {
  Arrivals arrivals;
  arrivals.closed("a.jpg", "first");
  arrivals.take_changes();
  arrivals.closed("a.jpg", "first");
  EXPECT_EQ(arrivals.take_changes().complete, Names{}) << "closed without being written";
  arrivals.written("a.jpg");
  EXPECT_EQ(arrivals.unsettled(), 1);
  arrivals.closed("a.jpg", "second");
  EXPECT_EQ(arrivals.take_changes().complete, Names{"a.jpg"});
  arrivals.look({{"a.jpg", "third"}});
  arrivals.look({{"a.jpg", "third"}});
  EXPECT_EQ(arrivals.take_changes().complete, Names{"a.jpg"}) << "a change that no event told";
}

TEST(Arrivals, what_is_being_written_waits_for_two_looks_after_the_last_word) {
  Arrivals arrivals;
  arrivals.look({{"a.jpg", "100 bytes"}});
  arrivals.written("a.jpg");
  arrivals.look({{"a.jpg", "100 bytes"}});
  EXPECT_EQ(arrivals.take_changes().complete, Names{});
  arrivals.look({{"a.jpg", "100 bytes"}});
  EXPECT_EQ(arrivals.take_changes().complete, Names{"a.jpg"});
}

TEST(Arrivals, what_is_not_found_any_more_is_gone) {
  Arrivals arrivals;
  for (const char* name : {"a.jpg", "b.jpg", "c.jpg"}) arrivals.closed(name, "stamp");
  arrivals.take_changes();
  arrivals.gone("a.jpg");
  arrivals.look({{"c.jpg", "stamp"}});
  const Arrivals::Changes changes = arrivals.take_changes();
  EXPECT_EQ(changes.gone, (Names{"a.jpg", "b.jpg"}));
  EXPECT_EQ(changes.complete, Names{});
  EXPECT_EQ(arrivals.known(), 1u);
}

TEST(FileKind, half_sent_and_hidden_files_are_none_of_ours) {
  for (const char* name : {"a.JPG", "b/c.tiff", "with space.png"})
    EXPECT_EQ(file_kind(name), FileKind::photograph) << name;
  for (const char* name : {"a.jpg.part", "a.tmp", "notes.txt", ".a.jpg", ".hidden/a.jpg", "b/.sync/a.jpg", "a"})
    EXPECT_EQ(file_kind(name), FileKind::other) << name;
  EXPECT_EQ(file_kind("b/poses.csv"), FileKind::poses);
  EXPECT_EQ(file_kind("b/cameras.csv"), FileKind::poses);
  EXPECT_EQ(file_kind("b/a.json"), FileKind::sidecar);
  EXPECT_EQ(file_kind("a.csv"), FileKind::sidecar);
}

TEST(FolderLook, finds_what_matters_below_the_folder_and_tells_when_it_is_away) {
  const testing_support::TempFolder folder;
  for (const char* name : {"a.jpg", "b/c d.png", "b/poses.csv", "x.txt", ".hidden/a.jpg", "new\nline.jpg"})
    testing_support::put_bytes(folder / name, name);
  const auto look = look_at_folder(folder.path());
  ASSERT_TRUE(look.has_value());
  Names names;
  for (const auto& [name, stamp] : *look) names.push_back(name);
  EXPECT_EQ(names, (Names{"a.jpg", "b/c d.png", "b/poses.csv", "new\nline.jpg"}));
  EXPECT_FALSE(look_at_folder(folder / "missing").has_value());
}

}  // namespace
}  // namespace skysweep::watch
