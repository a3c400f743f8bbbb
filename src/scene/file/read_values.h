// SPDX-License-Identifier: Apache-2.0
// Values of a scene file with the limits they must keep. All throw Error(usage) naming file, line and key.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/vec.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

using settings::TomlTable;

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-6;  // lower limit of what has to be above zero

// Replaces `value` by that of the key, if it is there; refuses it outside [low, high].
void read(const TomlTable& table, const std::string& key, double& value, double low = -kAny, double high = kAny);
void read(const TomlTable& table, const std::string& key, int& value, int low, int high);

// Exactly `count` numbers, or nothing if the key is absent.
std::optional<std::vector<double>> read_numbers(const TomlTable& table, const std::string& key, std::size_t count);

// Two numbers above zero.
void read_size(const TomlTable& table, const std::string& key, Vec2d& value);

template <typename T>
T required(std::optional<T> value, const std::string& what, const std::string& file) {
  if (!value) throw usage_error(file + ": " + what + " is missing");
  return *value;
}

}  // namespace skysweep::scene
