// SPDX-License-Identifier: Apache-2.0
// Writes a flat TOML document in the order of the calls, such that TomlTable reads back exactly what was written:
// doubles to the last bit, strings to the last byte.
//
//   TomlWriter toml;
//   toml.integer("format", 1);
//   toml.section("lattice");
//   toml.number("cell_m", 0.05);
//   write_file_atomically(path, toml.text());
#pragma once

#include <set>
#include <string>
#include <vector>

namespace skysweep::settings {

// Keys and section names are [A-Za-z0-9_-]+ (sections may be dotted), each given once: anything else is a bug.
class TomlWriter {
 public:
  void comment(const std::string& line);
  // What follows belongs to [name], until the next section.
  void section(const std::string& name);

  void number(const std::string& key, double value);  // must be finite
  void integer(const std::string& key, long long value);
  void boolean(const std::string& key, bool value);
  // Throws Error(bad_input) when the value is not UTF-8, which TOML cannot hold.
  void string(const std::string& key, const std::string& value);
  void numbers(const std::string& key, const std::vector<double>& values);
  void strings(const std::string& key, const std::vector<std::string>& values);

  const std::string& text() const { return text_; }

 private:
  void line(const std::string& key, const std::string& value);

  std::string text_;
  std::string section_;
  std::set<std::string> written_;  // full paths of keys and sections
};

}  // namespace skysweep::settings
