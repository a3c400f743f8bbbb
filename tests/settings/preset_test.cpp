// SPDX-License-Identifier: Apache-2.0
#include "settings/preset.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

#include "settings/embedded.h"
#include "settings/error_message.h"

namespace skysweep::settings {
namespace {

// Presets of the test's own: the circles and chains the real ones do not have.
PresetSource presets(const std::map<std::string, std::string_view>& texts) {
  return [texts](const std::string& name) -> std::optional<std::string_view> {
    const auto found = texts.find(name);
    if (found == texts.end()) return std::nullopt;
    return found->second;
  };
}

TEST(Embedded, files_are_those_of_the_config_folder_byte_for_byte) {
  for (const std::string_view name : embedded_file_names()) {
    std::ifstream file(std::string(CONFIG_FOLDER "/") + std::string(name), std::ios::binary);
    ASSERT_TRUE(file) << name;
    EXPECT_EQ(embedded_file(name), std::string(std::istreambuf_iterator<char>(file), {})) << name;
  }
  EXPECT_EQ(embedded_file("no_such_file.toml"), std::nullopt);
}

TEST(Presets, are_the_three_that_the_command_line_names) {
  EXPECT_EQ(preset_names(), (std::vector<std::string>{"accurate", "balanced", "fast"}));
  for (const std::string& name : preset_names()) EXPECT_NO_THROW(read_preset(name)) << name;
  EXPECT_NO_THROW(read_preset(std::string(kDefaultPreset)));
}

TEST(Presets, extend_each_other_and_the_nearer_wins) {
  const auto source = presets({{"low", "a = 1\nb = 1\nc = 1"},
                               {"middle", "extends = \"low\"\nb = 2\nc = 2"},
                               {"high", "extends = \"middle\"\nc = 3"}});
  const TomlTable high = read_preset("high", source);
  EXPECT_EQ(high.integer("a"), 1);
  EXPECT_EQ(high.integer("b"), 2);
  EXPECT_EQ(high.integer("c"), 3);
  EXPECT_EQ(high.where("a"), "preset low.toml:1: a");
  EXPECT_NO_THROW(high.refuse_unknown()) << "extends itself must be a known key";
}

TEST(Presets, of_an_unknown_name_are_refused_with_the_nearest) {
  EXPECT_EQ(error_message([] { read_preset("acurate"); }),
            "--preset: there is no preset \"acurate\"; did you mean accurate?");
  EXPECT_EQ(error_message([] { read_preset("ultra"); }),
            "--preset: there is no preset \"ultra\"; choose one of accurate balanced fast");
}

TEST(Presets, that_extend_an_unknown_one_are_refused_with_the_line) {
  const auto source = presets({{"a", "x = 1\nextends = \"fst\""}});
  EXPECT_EQ(error_message([&] { read_preset("a", source); }),
            "preset a.toml:2: extends: there is no preset \"fst\"; did you mean fast?");
}

TEST(Presets, in_a_circle_are_refused) {
  const auto source = presets({{"a", "extends = \"b\""}, {"b", "\nextends = \"a\""}});
  EXPECT_EQ(error_message([&] { read_preset("a", source); }),
            "preset b.toml:2: extends: preset \"a\" extends itself; break the circle");
}

TEST(ReadSettings, without_a_config_file_are_the_preset) {
  EXPECT_EQ(read_settings("fast", std::nullopt).string("extends"), "balanced");
}

TEST(ReadSettings, the_config_file_lies_over_the_preset) {
  const std::string path = testing::TempDir() + "read_settings_over_preset.toml";
  std::ofstream(path) << "[sweep]\nspecial_key_of_this_test = 7\n";
  const TomlTable settings = read_settings("fast", path);
  EXPECT_EQ(settings.string("extends"), "balanced") << "the preset must shine through";
  EXPECT_EQ(settings.table("sweep")->integer("special_key_of_this_test"), 7);
  EXPECT_EQ(settings.table("sweep")->where("special_key_of_this_test"), path + ":2: sweep.special_key_of_this_test");
}

TEST(ReadSettings, extends_in_a_config_file_is_refused_with_what_to_do) {
  const std::string path = testing::TempDir() + "read_settings_extends.toml";
  std::ofstream(path) << "extends = \"fast\"\n";
  EXPECT_EQ(error_message([&] { read_settings("balanced", path); }),
            path + ":1: extends is for presets only; remove the line and choose with --preset");
}

}  // namespace
}  // namespace skysweep::settings
