// SPDX-License-Identifier: Apache-2.0
#include "settings/toml_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/check.h"
#include "core/error.h"
#include "settings/toml/utf8.h"

namespace skysweep::settings {

namespace {

bool is_key_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

bool is_bare_key(const std::string& key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), is_key_character);
}

std::string number_text(double value) {
  SKY_CHECK(std::isfinite(value));
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  // "12" would read back as an integer, and "-0" would lose its sign.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string string_text(const std::string& value) {
  if (!is_utf8(value)) throw bad_input("\"" + value + "\" is not UTF-8 text and cannot be recorded; rename it");
  std::string text = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += {'\\', c};
    } else if (byte < 0x20 || byte == 0x7f) {
      std::array<char, 8> escape;
      std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(byte));
      text += escape.data();
    } else {
      text += c;
    }
  }
  return text + "\"";
}

template <typename T, typename ToText>
std::string array_text(const std::vector<T>& values, ToText to_text) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + to_text(values[i]);
  return text + "]";
}

}  // namespace

void TomlWriter::comment(const std::string& line) {
  SKY_CHECK(line.find_first_of("\r\n") == std::string::npos);
  text_ += "# " + line + "\n";
}

void TomlWriter::section(const std::string& name) {
  std::size_t begin = 0;
  for (std::size_t dot = 0; dot != std::string::npos; begin = dot + 1) {
    dot = name.find('.', begin);
    SKY_CHECK(is_bare_key(name.substr(begin, dot - begin)));
  }
  SKY_CHECK(written_.insert(name).second);
  section_ = name + ".";
  text_ += (text_.empty() ? "[" : "\n[") + name + "]\n";
}

void TomlWriter::line(const std::string& key, const std::string& value) {
  SKY_CHECK(is_bare_key(key));
  SKY_CHECK(written_.insert(section_ + key).second);
  text_ += key + " = " + value + "\n";
}

void TomlWriter::number(const std::string& key, double value) { line(key, number_text(value)); }
void TomlWriter::integer(const std::string& key, long long value) { line(key, std::to_string(value)); }
void TomlWriter::boolean(const std::string& key, bool value) { line(key, value ? "true" : "false"); }
void TomlWriter::string(const std::string& key, const std::string& value) { line(key, string_text(value)); }
void TomlWriter::numbers(const std::string& key, const std::vector<double>& values) {
  line(key, array_text(values, number_text));
}
void TomlWriter::strings(const std::string& key, const std::vector<std::string>& values) {
  line(key, array_text(values, string_text));
}

}  // namespace skysweep::settings
