// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "settings/error_message.h"
#include "settings/toml_table.h"

namespace skysweep::settings {
namespace {

TomlTable layers(const char* base, const char* over) {
  return layered(TomlTable::parse(base, "base.toml"), TomlTable::parse(over, "over.toml"));
}

TEST(TomlLayers, the_later_key_wins_and_the_others_stay) {
  const TomlTable table = layers("[sweep]\nviews = 8\nwindow = 5", "[sweep]\nviews = 4\nlevels = 2");
  const TomlTable sweep = *table.table("sweep");
  EXPECT_EQ(sweep.integer("views"), 4);
  EXPECT_EQ(sweep.integer("window"), 5);
  EXPECT_EQ(sweep.integer("levels"), 2);
}

TEST(TomlLayers, each_key_keeps_the_place_it_came_from) {
  const TomlTable sweep = *layers("[sweep]\nviews = 8\nwindow = 5", "\n\n[sweep]\nviews = 4").table("sweep");
  EXPECT_EQ(sweep.where("views"), "over.toml:4: sweep.views");
  EXPECT_EQ(sweep.where("window"), "base.toml:3: sweep.window");
}

TEST(TomlLayers, arrays_are_replaced_not_joined) {
  EXPECT_EQ(layers("a = [1, 2]", "a = [3]").numbers("a"), std::vector<double>{3});
  EXPECT_EQ(layers("[[a]]\nx = 1\n[[a]]", "[[a]]\ny = 1").tables("a").size(), 1u);
}

TEST(TomlLayers, a_value_over_a_table_wins_whole) {
  const TomlTable table = layers("[a]\nx = 1", "a = 2");
  EXPECT_EQ(table.integer("a"), 2);
  EXPECT_EQ(layers("a = 2", "[a]\nx = 1").table("a")->integer("x"), 1);
}

TEST(TomlLayers, unknown_keys_of_either_layer_are_refused_where_they_stand) {
  const TomlTable table = layers("a = 1\nextra = 2", "a = 3");
  table.integer("a");
  EXPECT_EQ(error_message([&] { table.refuse_unknown(); }),
            "base.toml:2: unknown key extra; the keys known here are a");
}

TEST(TomlLayers, what_was_asked_of_a_layer_was_not_asked_of_the_result) {
  const TomlTable base = TomlTable::parse("[a]\nx = 1", "base.toml");
  base.table("a")->integer("x");
  const TomlTable table = layered(base, TomlTable::parse("[b]", "over.toml"));
  table.table("a");
  table.table("b");
  EXPECT_EQ(error_message([&] { table.refuse_unknown(); }),
            "base.toml:2: unknown key a.x; nothing is read here, remove it");
}

}  // namespace
}  // namespace skysweep::settings
