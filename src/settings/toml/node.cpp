// SPDX-License-Identifier: Apache-2.0
#include "settings/toml/node.h"

#include <algorithm>

namespace skysweep::settings {

namespace {

const TomlNode* as_node(const TomlValue& value) {
  const auto* node = std::get_if<std::shared_ptr<TomlNode>>(&value.value);
  return node ? node->get() : nullptr;
}

TomlValue clone(const TomlValue& value) {
  if (const TomlNode* node = as_node(value)) return {clone(*node)};
  if (const auto* array = std::get_if<TomlArray>(&value.value)) {
    TomlArray copy;
    for (const TomlValue& element : *array) copy.push_back(clone(element));
    return {std::move(copy)};
  }
  return value;
}

}  // namespace

const TomlEntry* TomlNode::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

std::string to_string(const TomlPlace& place) {
  return place.line == 0 ? place.file : place.file + ":" + std::to_string(place.line);
}

std::shared_ptr<TomlNode> clone(const TomlNode& node) {
  auto copy = std::make_shared<TomlNode>(TomlNode{node.path, node.place, {}, {}});
  for (const TomlEntry& entry : node.entries) copy->entries.push_back({entry.key, clone(entry.value), entry.place});
  return copy;
}

std::shared_ptr<TomlNode> layered(const TomlNode& base, const TomlNode& over) {
  auto result = std::make_shared<TomlNode>(TomlNode{over.path, over.place, {}, {}});
  for (const TomlEntry& below : base.entries) {
    const TomlEntry* above = over.find(below.key);
    if (!above) {
      result->entries.push_back({below.key, clone(below.value), below.place});
    } else if (as_node(below.value) && as_node(above->value)) {
      result->entries.push_back({below.key, {layered(*as_node(below.value), *as_node(above->value))}, above->place});
    } else {
      result->entries.push_back({above->key, clone(above->value), above->place});
    }
  }
  for (const TomlEntry& above : over.entries)
    if (!base.find(above.key)) result->entries.push_back({above.key, clone(above.value), above.place});
  return result;
}

}  // namespace skysweep::settings
