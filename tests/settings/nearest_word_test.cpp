// SPDX-License-Identifier: Apache-2.0
#include "settings/nearest_word.h"

#include <gtest/gtest.h>

namespace skysweep::settings {
namespace {

TEST(EditDistance, counts_each_kind_of_slip_once) {
  EXPECT_EQ(edit_distance("cell", "cell"), 0);
  EXPECT_EQ(edit_distance("cell", "cel"), 1);
  EXPECT_EQ(edit_distance("cell", "cello"), 1);
  EXPECT_EQ(edit_distance("cell", "bell"), 1);
  EXPECT_EQ(edit_distance("cell", "clel"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(EditDistance, from_nothing_is_the_length) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
}

TEST(EditDistance, is_symmetric) { EXPECT_EQ(edit_distance("window_m", "widow"), edit_distance("widow", "window_m")); }

TEST(NearestWord, picks_the_nearest_and_the_first_of_equals) {
  EXPECT_EQ(nearest_word("altitud_m", {"speed", "altitude_m", "attitude"}), "altitude_m");
  EXPECT_EQ(nearest_word("view", {"views", "viewe"}), "views");
}

TEST(NearestWord, says_nothing_when_none_is_alike) {
  EXPECT_EQ(nearest_word("threads", {"cell", "origin"}), std::nullopt);
  EXPECT_EQ(nearest_word("dz", {"xy"}), std::nullopt);
  EXPECT_EQ(nearest_word("anything", {}), std::nullopt);
}

}  // namespace
}  // namespace skysweep::settings
