// SPDX-License-Identifier: Apache-2.0
#include "pipeline/removals.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::pipeline {
namespace {

using testing_support::put_bytes;
using testing_support::TempFolder;

std::vector<index::ImageRecord> photographs(const std::vector<std::string>& names) {
  std::vector<index::ImageRecord> records(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) records[i].name = names[i];
  return records;
}

TEST(Removals, come_back_from_the_project_with_any_name) {
  const TempFolder folder;
  const ProjectPaths paths(folder.path());
  EXPECT_TRUE(read_removals(paths).empty());
  const std::set<std::string> names = {"a b.jpg", "o'neill's \"best\".jpg", "line\nbreak.jpg", "\xc3\x9c.jpg"};
  write_removals(paths, names);
  EXPECT_EQ(read_removals(paths), names);
  put_bytes(paths.removals(), "photograph = []\n");
  EXPECT_THROW(read_removals(paths), Error);
}

TEST(Removals, patterns_are_those_of_a_shell_over_the_whole_name) {
  const auto all = photographs({"east/1.jpg", "east/2.jpg", "west/1.jpg", "[x].jpg"});
  const auto removed = [&](const std::string& pattern) { return changed_removals({}, all, {pattern}, {}); };
  EXPECT_EQ(removed("east/*"), (std::set<std::string>{"east/1.jpg", "east/2.jpg"}));
  EXPECT_EQ(removed("*1.jpg"), (std::set<std::string>{"east/1.jpg", "west/1.jpg"}));
  EXPECT_EQ(removed("east/[2-9].jp?"), (std::set<std::string>{"east/2.jpg"}));
  EXPECT_EQ(removed("\\[x\\].jpg"), (std::set<std::string>{"[x].jpg"}));
  EXPECT_THROW(removed("1.jpg"), Error);
}

TEST(Removals, of_photographs_whose_files_are_gone_can_be_taken_back) {
  EXPECT_TRUE(changed_removals({"gone.jpg"}, photographs({"here.jpg"}), {}, {"gone*"}).empty());
  EXPECT_EQ(changed_removals({"gone.jpg"}, photographs({"here.jpg"}), {"here.jpg"}, {}),
            (std::set<std::string>{"gone.jpg", "here.jpg"}));
}

TEST(Removals, must_leave_two_photographs) {
  auto records = photographs({"a", "b", "c"});
  mark_removed(records, {"b"});
  EXPECT_EQ(records[1].status, index::ImageStatus::removed);
  EXPECT_EQ(records[0].status, index::ImageStatus::used);
  EXPECT_THROW(mark_removed(records, {"a", "b"}), Error);
}

}  // namespace
}  // namespace skysweep::pipeline
