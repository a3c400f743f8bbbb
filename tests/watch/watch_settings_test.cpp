// SPDX-License-Identifier: Apache-2.0
#include "watch/watch_settings.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::watch {
namespace {

class WatchSettingsFile : public testing::Test {
 protected:
  WatchSettings read(const std::string& text) {
    testing_support::put_bytes(folder / "watch.toml", text);
    return with_file({}, folder / "watch.toml");
  }
  std::string refusal(const std::string& text) {
    return testing_support::message_of<Error>([&] { read(text); });
  }
  testing_support::TempFolder folder;
};

TEST_F(WatchSettingsFile, says_everything_that_may_change) {
  const WatchSettings settings = read(
      "[watch]\ngroup = \"time\"\ngroup_gap = 30\nfirst = 8\npoll_seconds = 2.5\nmemory_mib = 1024\nthreads = 3\n");
  EXPECT_EQ(settings.group, GroupRule::time);
  EXPECT_EQ(settings.gap(), 30);
  EXPECT_EQ(settings.first, 8);
  EXPECT_EQ(settings.poll_s, 2.5);
  EXPECT_EQ(settings.memory_bytes, std::size_t{1} << 30);
  EXPECT_EQ(settings.threads, 3);
  EXPECT_EQ(read("").first, WatchSettings{}.first);
}

TEST_F(WatchSettingsFile, gaps_have_the_unit_of_their_rule) {
  EXPECT_EQ(read("[watch]\ngroup = \"time\"").gap(), 10);
  EXPECT_EQ(read("[watch]\ngroup = \"distance\"").gap(), 200);
}

TEST_F(WatchSettingsFile, what_makes_no_sense_is_refused_with_a_sentence) {
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"[watch]\ngroup = \"color\"", "none, folder, time or distance"},
           {"[watch]\ngroup = \"time\"\ngroup_gap = 0", "positive"},
           {"[watch]\ngroup_gap = 5", "no effect"},
           {"[watch]\nfirst = 1", "2 photographs"},
           {"[watch]\npoll_seconds = 0", "0.05"},
           {"[watch]\nthreads = 0", "threads"},
           {"[watch]\nmemory_mib = 0", "memory_mib"},
           {"[watch]\nfrist = 3", "first"},
           {"[watcher]\nfirst = 3", "watch"}}) {
    const std::string sentence = refusal(text);
    EXPECT_NE(sentence.find(word), std::string::npos) << text << ": " << sentence;
    EXPECT_NE(sentence.find("watch.toml"), std::string::npos) << sentence;
  }
}

}  // namespace
}  // namespace skysweep::watch
