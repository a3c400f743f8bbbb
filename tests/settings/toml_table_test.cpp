// SPDX-License-Identifier: Apache-2.0
#include "settings/toml_table.h"

#include <gtest/gtest.h>

#include <fstream>

#include "settings/error_message.h"

namespace skysweep::settings {
namespace {

constexpr const char* kScene = R"(name = "town"
seed = 7
flat = false

[flight]
altitude_m = 120.5
lines = [0, 12.5, -3]

[[building]]
roof = "gable"
[[building]]
roof = "flat"
tags = ["a", "b"]
)";

TomlTable scene() { return TomlTable::parse(kScene, "scene.toml"); }

TEST(TomlTable, gives_each_type_as_it_stands) {
  const TomlTable table = scene();
  EXPECT_EQ(table.string("name"), "town");
  EXPECT_EQ(table.integer("seed"), 7);
  EXPECT_EQ(table.boolean("flat"), false);
  EXPECT_EQ(table.table("flight")->number("altitude_m"), 120.5);
  EXPECT_EQ(table.table("flight")->numbers("lines"), (std::vector<double>{0, 12.5, -3}));
  const std::vector<TomlTable> buildings = table.tables("building");
  ASSERT_EQ(buildings.size(), 2u);
  EXPECT_EQ(buildings[0].string("roof"), "gable");
  EXPECT_EQ(buildings[1].strings("tags"), (std::vector<std::string>{"a", "b"}));
}

TEST(TomlTable, a_whole_number_is_a_number_too) { EXPECT_EQ(scene().number("seed"), 7.0); }

TEST(TomlTable, absent_keys_give_nothing) {
  const TomlTable table = scene();
  EXPECT_EQ(table.string("x"), std::nullopt);
  EXPECT_EQ(table.integer("x"), std::nullopt);
  EXPECT_EQ(table.boolean("x"), std::nullopt);
  EXPECT_EQ(table.number("x"), std::nullopt);
  EXPECT_EQ(table.numbers("x"), std::nullopt);
  EXPECT_EQ(table.strings("x"), std::nullopt);
  EXPECT_FALSE(table.table("x").has_value());
  EXPECT_TRUE(table.tables("x").empty());
  EXPECT_FALSE(table.has("x"));
  EXPECT_TRUE(table.has("name"));
}

TEST(TomlTable, one_table_or_several_are_read_alike) {
  const TomlTable one = TomlTable::parse("[flight]\na = 1\n", "f.toml");
  const TomlTable two = TomlTable::parse("[[flight]]\na = 1\n[[flight]]\na = 2\n", "f.toml");
  ASSERT_EQ(one.one_or_more_tables("flight").size(), 1u);
  EXPECT_EQ(one.one_or_more_tables("flight")[0].number("a"), 1);
  ASSERT_EQ(two.one_or_more_tables("flight").size(), 2u);
  EXPECT_EQ(two.one_or_more_tables("flight")[1].number("a"), 2);
  EXPECT_TRUE(one.one_or_more_tables("absent").empty());
  const TomlTable wrong = TomlTable::parse("flight = 3\n", "f.toml");
  EXPECT_NE(error_message([&] { wrong.one_or_more_tables("flight"); }).find("array of tables"), std::string::npos);
}

TEST(TomlTable, the_wrong_type_is_told_with_file_line_and_key) {
  const TomlTable table = scene();
  EXPECT_EQ(error_message([&] { table.number("name"); }), "scene.toml:1: name must be a number, but is a string");
  EXPECT_EQ(error_message([&] { table.string("seed"); }),
            "scene.toml:2: seed must be a string in quotes, but is a whole number");
  EXPECT_EQ(error_message([&] { table.integer("flat"); }),
            "scene.toml:3: flat must be a whole number, but is a boolean");
  EXPECT_EQ(error_message([&] { table.boolean("seed"); }),
            "scene.toml:2: seed must be true or false, but is a whole number");
  EXPECT_EQ(error_message([&] { table.table("name"); }), "scene.toml:1: name must be a table, but is a string");
  EXPECT_EQ(error_message([&] { table.tables("flight"); }),
            "scene.toml:5: flight must be an array of tables, but is a table");
  const TomlTable flight = *table.table("flight");
  EXPECT_EQ(error_message([&] { flight.integer("altitude_m"); }),
            "scene.toml:6: flight.altitude_m must be a whole number, but is a number with a fraction");
  EXPECT_EQ(error_message([&] { flight.numbers("altitude_m"); }),
            "scene.toml:6: flight.altitude_m must be an array of numbers, but is a number with a fraction");
  EXPECT_EQ(error_message([&] { flight.boolean("lines"); }),
            "scene.toml:7: flight.lines must be true or false, but is an array");
  EXPECT_EQ(error_message([&] { table.tables("building")[1].strings("roof"); }),
            "scene.toml:12: building[1].roof must be an array of strings, but is a string");
}

TEST(TomlTable, the_wrong_element_of_an_array_is_numbered) {
  const TomlTable table = TomlTable::parse("a = [1, \"b\", 3]\nd = 1979-05-27\nt = [{x = 1}, 2]", "f.toml");
  EXPECT_EQ(error_message([&] { table.numbers("a"); }), "f.toml:1: a[1] must be a number, but is a string");
  EXPECT_EQ(error_message([&] { table.strings("a"); }),
            "f.toml:1: a[0] must be a string in quotes, but is a whole number");
  EXPECT_EQ(error_message([&] { table.number("d"); }), "f.toml:2: d must be a number, but is a date or time");
  EXPECT_EQ(error_message([&] { table.tables("t"); }), "f.toml:3: t[1] must be a table, but is a whole number");
}

TEST(TomlTable, infinite_numbers_are_refused) {
  const TomlTable table = TomlTable::parse("a = inf\nb = [nan]", "f.toml");
  EXPECT_EQ(error_message([&] { table.number("a"); }), "f.toml:1: a must be a finite number, not inf or nan");
  EXPECT_EQ(error_message([&] { table.numbers("b"); }), "f.toml:2: b[0] must be a finite number, not inf or nan");
}

TEST(TomlTable, where_names_the_line_of_a_key_or_of_the_table_that_lacks_it) {
  const TomlTable table = scene();
  EXPECT_EQ(table.where("seed"), "scene.toml:2: seed");
  EXPECT_EQ(table.where("origin"), "scene.toml: origin");
  EXPECT_EQ(table.table("flight")->where("altitude_m"), "scene.toml:6: flight.altitude_m");
  EXPECT_EQ(table.table("flight")->where("speed"), "scene.toml:5: flight.speed");
  EXPECT_EQ(table.tables("building")[1].where("height_m"), "scene.toml:11: building[1].height_m");
}

TEST(TomlTable, what_is_not_toml_is_refused_with_its_line) {
  const auto message = [](const char* text) { return error_message([&] { TomlTable::parse(text, "f.toml"); }); };
  EXPECT_EQ(message("a = 1\nb = ").rfind("f.toml:2: this is not TOML: ", 0), 0u) << message("a = 1\nb = ");
  EXPECT_EQ(message("a = 1\na = 2").rfind("f.toml:2: this is not TOML: ", 0), 0u) << message("a = 1\na = 2");
}

TEST(TomlTable, reads_a_file_and_names_it_in_messages) {
  const std::string path = testing::TempDir() + "toml_table_reads_a_file.toml";
  std::ofstream(path) << "cell = 5\n";
  EXPECT_EQ(TomlTable::read_file(path).integer("cell"), 5);
  EXPECT_EQ(TomlTable::read_file(path).where("cell"), path + ":1: cell");
}

TEST(TomlTable, a_file_that_is_not_there_is_named) {
  const std::string missing = testing::TempDir() + "no_such_file.toml";
  EXPECT_EQ(error_message([&] { TomlTable::read_file(missing); }),
            missing + ": cannot be read; give the path of a TOML file");
  EXPECT_EQ(error_message([&] { TomlTable::read_file(testing::TempDir()); }),
            testing::TempDir() + ": cannot be read; give the path of a TOML file");
}

}  // namespace
}  // namespace skysweep::settings
