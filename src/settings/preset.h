// SPDX-License-Identifier: Apache-2.0
// Presets (config/*.toml, embedded in the program) and a user's file over them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "settings/toml_table.h"

namespace skysweep::settings {

inline constexpr std::string_view kDefaultPreset = "balanced";

// The names --preset takes: "accurate", "balanced", "fast".
std::vector<std::string> preset_names();

// The text of the preset of that name, if there is one.
using PresetSource = std::function<std::optional<std::string_view>(const std::string& name)>;
std::optional<std::string_view> embedded_preset(const std::string& name);

// The preset with everything it `extends` below it. Throws Error(usage) for a name that is none, with the nearest that
// is, and for presets that extend each other in a circle.
TomlTable read_preset(const std::string& name, const PresetSource& source = embedded_preset);

// The preset with the user's --config file over it, key by key. Nothing is refused yet: whoever reads the options calls
// refuse_unknown() on the result.
TomlTable read_settings(const std::string& preset, const std::optional<std::filesystem::path>& config);

}  // namespace skysweep::settings
