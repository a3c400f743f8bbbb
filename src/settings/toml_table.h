// SPDX-License-Identifier: Apache-2.0
// Strict reading of TOML: every key must be asked for by somebody, or the file is refused. A typing mistake in a
// configuration is found in the first second, not after hours of work.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace skysweep::settings {

struct TomlNode;

// One table of a TOML document. Reading functions return nothing when the key is absent and throw Error(usage), naming
// file, line and key, when the value has the wrong type. Copies share the record of which keys were asked for.
class TomlTable {
 public:
  static TomlTable read_file(const std::filesystem::path& path);
  // `name` stands for the file in messages.
  static TomlTable parse(const std::string& text, const std::string& name);

  std::optional<double> number(const std::string& key) const;  // integers are numbers too; must be finite
  std::optional<long long> integer(const std::string& key) const;
  std::optional<bool> boolean(const std::string& key) const;
  std::optional<std::string> string(const std::string& key) const;
  std::optional<std::vector<double>> numbers(const std::string& key) const;
  std::optional<std::vector<std::string>> strings(const std::string& key) const;
  std::optional<TomlTable> table(const std::string& key) const;
  std::vector<TomlTable> tables(const std::string& key) const;  // array of tables; empty when absent
  // A single table or an array of tables, whichever stands there; empty when absent.
  std::vector<TomlTable> one_or_more_tables(const std::string& key) const;
  bool has(const std::string& key) const;

  // "scene.toml:12: flight.altitude_m", for messages about the value of a key.
  std::string where(const std::string& key) const;

  // Throws Error(usage) naming the first key (in this table or below) that nobody asked for, its line, and the nearest
  // key that somebody did ask for. Call it when everything has been read: looking (`has`) counts as asking.
  void refuse_unknown() const;

 private:
  explicit TomlTable(std::shared_ptr<TomlNode> node) : node_(std::move(node)) {}
  friend TomlTable layered(const TomlTable& base, const TomlTable& over);
  std::shared_ptr<TomlNode> node_;
};

// `base` with the keys of `over` laid on it: tables merge key by key, of everything else (arrays too) the one in `over`
// stands. Each key keeps the file and line it came from. The result has a record of asked keys of its own.
TomlTable layered(const TomlTable& base, const TomlTable& over);

}  // namespace skysweep::settings
