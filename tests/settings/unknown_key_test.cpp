// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "settings/error_message.h"
#include "settings/toml_table.h"

namespace skysweep::settings {
namespace {

std::string refusal(const TomlTable& table) {
  return error_message([&] { table.refuse_unknown(); });
}

TEST(UnknownKey, nothing_is_refused_when_all_was_asked_for) {
  const TomlTable table = TomlTable::parse("a = 1\nb = {c = 2}\nd = [{e = 3}]", "f.toml");
  table.number("a");
  table.table("b")->number("c");
  table.tables("d")[0].number("e");
  EXPECT_NO_THROW(table.refuse_unknown());
}

TEST(UnknownKey, is_refused_with_its_line_and_the_nearest_key_asked_for) {
  const TomlTable table = TomlTable::parse("[flight]\naltitud_m = 100", "scene.toml");
  table.table("flight")->number("altitude_m");
  table.table("flight")->number("speed");
  EXPECT_EQ(refusal(table), "scene.toml:2: unknown key flight.altitud_m; did you mean altitude_m?");
}

TEST(UnknownKey, unlike_all_others_lists_what_is_known) {
  const TomlTable table = TomlTable::parse("color = 1", "f.toml");
  table.number("dz_m");
  table.number("cell_m");
  EXPECT_EQ(refusal(table), "f.toml:1: unknown key color; the keys known here are cell_m, dz_m");
}

TEST(UnknownKey, where_nothing_is_read_says_so) {
  const TomlTable table = TomlTable::parse("[empty]\nx = 1", "f.toml");
  table.table("empty");
  EXPECT_EQ(refusal(table), "f.toml:2: unknown key empty.x; nothing is read here, remove it");
}

TEST(UnknownKey, the_first_of_the_file_is_named) {
  const TomlTable table = TomlTable::parse("zebra = 1\nant = 2", "f.toml");
  table.number("cell");
  EXPECT_EQ(refusal(table), "f.toml:1: unknown key zebra; the keys known here are cell");
}

TEST(UnknownKey, in_a_table_nobody_asked_for_is_told_by_the_table) {
  const TomlTable table = TomlTable::parse("[swep]\nx = 1", "f.toml");
  table.table("sweep");
  EXPECT_EQ(refusal(table), "f.toml:1: unknown key swep; did you mean sweep?");
}

TEST(UnknownKey, in_an_array_of_tables_is_found) {
  const TomlTable table = TomlTable::parse("[[house]]\nroof = 1\n[[house]]\nrof = 1", "f.toml");
  for (const TomlTable& house : table.tables("house")) house.number("roof");
  EXPECT_EQ(refusal(table), "f.toml:4: unknown key house[1].rof; did you mean roof?");
}

TEST(UnknownKey, looking_counts_as_asking) {
  const TomlTable table = TomlTable::parse("a = 1", "f.toml");
  table.has("a");
  EXPECT_NO_THROW(table.refuse_unknown());
}

}  // namespace
}  // namespace skysweep::settings
