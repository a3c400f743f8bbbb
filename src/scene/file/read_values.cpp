// SPDX-License-Identifier: Apache-2.0
#include "scene/file/read_values.h"

#include <sstream>

namespace skysweep::scene {

void read(const TomlTable& table, const std::string& key, double& value, double low, double high) {
  const std::optional<double> found = table.number(key);
  if (!found) return;
  if (*found < low || *found > high) {
    std::ostringstream range;
    if (low == kTiny && high == kAny)
      range << "must be above 0";
    else if (high == kAny)
      range << "must be at least " << low;
    else
      range << "must lie between " << low << " and " << high;
    throw usage_error(table.where(key) + " " + range.str());
  }
  value = *found;
}

void read(const TomlTable& table, const std::string& key, int& value, int low, int high) {
  const std::optional<long long> found = table.integer(key);
  if (!found) return;
  if (*found < low || *found > high)
    throw usage_error(table.where(key) + " must lie between " + std::to_string(low) + " and " + std::to_string(high));
  value = static_cast<int>(*found);
}

std::optional<std::vector<double>> read_numbers(const TomlTable& table, const std::string& key, std::size_t count) {
  std::optional<std::vector<double>> found = table.numbers(key);
  if (found && found->size() != count)
    throw usage_error(table.where(key) + " must be a list of " + std::to_string(count) + " numbers");
  return found;
}

void read_size(const TomlTable& table, const std::string& key, Vec2d& value) {
  const auto found = read_numbers(table, key, 2);
  if (!found) return;
  value = {(*found)[0], (*found)[1]};
  if (!(value.x > 0 && value.y > 0)) throw usage_error(table.where(key) + " must be two numbers above 0");
}

}  // namespace skysweep::scene
