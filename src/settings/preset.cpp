// SPDX-License-Identifier: Apache-2.0
#include "settings/preset.h"

#include <algorithm>

#include "core/error.h"
#include "settings/embedded.h"
#include "settings/nearest_word.h"

namespace skysweep::settings {

namespace {

constexpr std::string_view kSuffix = ".toml";

// `asked_by` is where the name was written, for the message: "--preset", or a line of another preset.
std::string preset_text(const std::string& name, const std::string& asked_by, const PresetSource& source) {
  if (const auto text = source(name)) return std::string(*text);
  std::string message = asked_by + ": there is no preset \"" + name + "\"";
  if (const auto nearest = nearest_word(name, preset_names()))
    throw usage_error(message + "; did you mean " + *nearest + "?");
  message += "; choose one of";
  for (const std::string& known : preset_names()) message += " " + known;
  throw usage_error(message);
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const std::string_view file : embedded_file_names())
    if (file.ends_with(kSuffix)) names.emplace_back(file.substr(0, file.size() - kSuffix.size()));
  return names;
}

std::optional<std::string_view> embedded_preset(const std::string& name) {
  return embedded_file(name + std::string(kSuffix));
}

TomlTable read_preset(const std::string& name, const PresetSource& source) {
  std::optional<TomlTable> result;
  std::vector<std::string> chain;
  std::optional<std::string> next = name;
  std::string asked_by = "--preset";
  while (next) {
    if (std::find(chain.begin(), chain.end(), *next) != chain.end())
      throw usage_error(asked_by + ": preset \"" + *next + "\" extends itself; break the circle");
    chain.push_back(*next);
    const TomlTable preset =
        TomlTable::parse(preset_text(*next, asked_by, source), "preset " + *next + std::string(kSuffix));
    result = result ? layered(preset, *result) : preset;
    next = preset.string("extends");
    asked_by = preset.where("extends");
  }
  result->has("extends");  // asked for here, so that refuse_unknown() knows it
  return *result;
}

TomlTable read_settings(const std::string& preset, const std::optional<std::filesystem::path>& config) {
  TomlTable base = read_preset(preset);
  if (!config) return base;
  const TomlTable over = TomlTable::read_file(*config);
  if (over.has("extends"))
    throw usage_error(over.where("extends") + " is for presets only; remove the line and choose with --preset");
  TomlTable result = layered(base, over);
  result.has("extends");
  return result;
}

}  // namespace skysweep::settings
