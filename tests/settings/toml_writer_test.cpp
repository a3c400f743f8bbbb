// SPDX-License-Identifier: Apache-2.0
#include "settings/toml_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "settings/error_message.h"
#include "settings/toml_table.h"

namespace skysweep::settings {
namespace {

TomlTable read_back(const TomlWriter& toml) { return TomlTable::parse(toml.text(), "written.toml"); }

std::string string_read_back(const std::string& value) {
  TomlWriter toml;
  toml.string("s", value);
  return read_back(toml).string("s").value();
}

TEST(TomlWriter, writes_in_the_order_of_the_calls) {
  TomlWriter toml;
  toml.comment("made by a test");
  toml.integer("format", 1);
  toml.section("lattice");
  toml.number("cell_m", 0.05);
  toml.numbers("origin", {0, -1e7});
  toml.section("images");
  toml.boolean("strict", true);
  toml.strings("names", {"a.jpg", "b \"c\".jpg"});
  EXPECT_EQ(toml.text(), R"(# made by a test
format = 1

[lattice]
cell_m = 0.05
origin = [0.0, -1e+07]

[images]
strict = true
names = ["a.jpg", "b \"c\".jpg"]
)");
}

TEST(TomlWriter, every_finite_double_reads_back_to_the_last_bit) {
  std::vector<double> values = {0.0,
                                -0.0,
                                0.1,
                                1.0 / 3,
                                12.0,
                                1e22,
                                1e23,
                                5e-324,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::min(),
                                51.2,
                                1e15,
                                123456789012345680.0};
  Random random(1);
  while (values.size() < 20000) {
    const double value = std::bit_cast<double>(random.next());
    if (std::isfinite(value)) values.push_back(value);
  }
  TomlWriter toml;
  toml.numbers("values", values);
  const std::vector<double> back = read_back(toml).numbers("values").value();
  ASSERT_EQ(back.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(values[i])) << values[i];
}

TEST(TomlWriter, a_double_without_fraction_stays_a_double) {
  TomlWriter toml;
  toml.number("a", 12);
  EXPECT_EQ(toml.text(), "a = 12.0\n");
}

TEST(TomlWriter, the_widest_integers_read_back) {
  TomlWriter toml;
  toml.integer("min", std::numeric_limits<long long>::min());
  toml.integer("max", std::numeric_limits<long long>::max());
  EXPECT_EQ(read_back(toml).integer("min"), std::numeric_limits<long long>::min());
  EXPECT_EQ(read_back(toml).integer("max"), std::numeric_limits<long long>::max());
}

TEST(TomlWriter, every_ascii_character_reads_back) {
  std::string all;
  for (char c = 0; c < 127; ++c) all += c;
  all += '\x7f';
  EXPECT_EQ(string_read_back(all), all);
}

TEST(TomlWriter, strings_of_any_language_read_back) {
  for (const std::string text : {"", "C:\\photos\\n", "Zürich", "東京", "🛩 \u0080 \uffff", "line\r\nline\t#"})
    EXPECT_EQ(string_read_back(text), text);
}

TEST(TomlWriter, what_is_not_utf8_is_refused) {
  // A stray continuation, a cut sequence, overlong forms, a surrogate, beyond U+10FFFF, Latin-1.
  for (const std::string text : {"\x80", "\xe6\x9d", "\xc0\xaf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xed\xa0\x80",
                                 "\xf4\x90\x80\x80", "Z\xfcrich"}) {
    TomlWriter toml;
    EXPECT_EQ(error_message([&] { toml.string("s", text); }, ErrorKind::bad_input),
              "\"" + text + "\" is not UTF-8 text and cannot be recorded; rename it");
  }
}

TEST(TomlWriter, dotted_sections_nest) {
  TomlWriter toml;
  toml.section("sweep.cost");
  toml.integer("radius", 3);
  EXPECT_EQ(read_back(toml).table("sweep")->table("cost")->integer("radius"), 3);
}

TEST(TomlWriterDeathTest, writing_a_key_twice_is_a_bug) {
  TomlWriter toml;
  toml.integer("a", 1);
  EXPECT_DEATH(toml.integer("a", 2), "should never be false");
  toml.section("s");
  toml.integer("a", 1);
  EXPECT_DEATH(toml.section("s"), "should never be false");
}

TEST(TomlWriterDeathTest, keys_and_numbers_that_do_not_read_back_are_bugs) {
  TomlWriter toml;
  EXPECT_DEATH(toml.integer("a b", 1), "is_bare_key");
  EXPECT_DEATH(toml.integer("", 1), "is_bare_key");
  EXPECT_DEATH(toml.section("a..b"), "is_bare_key");
  EXPECT_DEATH(toml.number("a", std::numeric_limits<double>::infinity()), "isfinite");
}

}  // namespace
}  // namespace skysweep::settings
