// SPDX-License-Identifier: Apache-2.0
// What TomlTable stands on: a TOML document as plain values, each with the place it came from. Free of toml++, so that
// the library is named in one file only.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace skysweep::settings {

struct TomlNode;
struct TomlValue;
using TomlArray = std::vector<TomlValue>;
struct TomlDate {};  // known only so that a message can say what stands there

struct TomlValue {
  std::variant<bool, long long, double, std::string, TomlDate, TomlArray, std::shared_ptr<TomlNode>> value;
};

struct TomlPlace {
  std::string file;
  int line = 0;  // from 1; 0: the file as a whole
};

struct TomlEntry {
  std::string key;
  TomlValue value;
  TomlPlace place;
};

struct TomlNode {
  std::string path;  // "flight.camera"; empty for the document itself
  TomlPlace place;
  std::vector<TomlEntry> entries;  // in the order of the file
  std::set<std::string> asked;     // keys somebody read or looked for, present or not

  const TomlEntry* find(const std::string& key) const;
  std::string path_of(const std::string& key) const { return path.empty() ? key : path + "." + key; }
};

// "scene.toml:12", or the file alone where there is no line to name.
std::string to_string(const TomlPlace& place);

// Throws Error(usage) with file and line when `text` is not TOML.
std::shared_ptr<TomlNode> parse_toml(const std::string& text, const std::string& file);

// A copy that shares nothing, and of whose keys none has been asked for.
std::shared_ptr<TomlNode> clone(const TomlNode& node);

std::shared_ptr<TomlNode> layered(const TomlNode& base, const TomlNode& over);

}  // namespace skysweep::settings
