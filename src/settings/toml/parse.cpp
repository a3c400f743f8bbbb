// SPDX-License-Identifier: Apache-2.0
#include <toml++/toml.h>

#include <algorithm>

#include "core/error.h"
#include "settings/toml/node.h"

namespace skysweep::settings {

namespace {

std::shared_ptr<TomlNode> convert_table(const toml::table& table, const std::string& path, const TomlPlace& place);

TomlValue convert(const toml::node& node, const std::string& path, const TomlPlace& place) {
  if (const auto* table = node.as_table()) return {convert_table(*table, path, place)};
  if (const auto* boolean = node.as_boolean()) return {boolean->get()};
  if (const auto* integer = node.as_integer()) return {static_cast<long long>(integer->get())};
  if (const auto* number = node.as_floating_point()) return {number->get()};
  if (const auto* text = node.as_string()) return {text->get()};
  if (const auto* array = node.as_array()) {
    TomlArray values;
    for (const toml::node& element : *array) {
      const TomlPlace element_place{place.file, static_cast<int>(element.source().begin.line)};
      values.push_back(convert(element, path + "[" + std::to_string(values.size()) + "]", element_place));
    }
    return {std::move(values)};
  }
  return {TomlDate{}};
}

// toml++ keeps keys in alphabetical order; messages and layers want the order of the file.
std::shared_ptr<TomlNode> convert_table(const toml::table& table, const std::string& path, const TomlPlace& place) {
  std::vector<std::pair<toml::source_position, const toml::key*>> order;
  for (const auto& [key, value] : table) order.emplace_back(key.source().begin, &key);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  auto node = std::make_shared<TomlNode>(TomlNode{path, place, {}, {}});
  for (const auto& [position, key] : order) {
    const std::string name(key->str());
    const TomlPlace key_place{place.file, static_cast<int>(position.line)};
    node->entries.push_back({name, convert(*table.get(name), node->path_of(name), key_place), key_place});
  }
  return node;
}

}  // namespace

std::shared_ptr<TomlNode> parse_toml(const std::string& text, const std::string& file) {
  try {
    return convert_table(toml::parse(text), "", {file, 0});
  } catch (const toml::parse_error& error) {
    const TomlPlace place{file, static_cast<int>(error.source().begin.line)};
    throw usage_error(to_string(place) + ": this is not TOML: " + std::string(error.description()));
  }
}

}  // namespace skysweep::settings
