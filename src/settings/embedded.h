// SPDX-License-Identifier: Apache-2.0
// The files of config/ that travel inside the program (list: CMakeLists.txt beside this file), so that it needs no
// installation folder.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace skysweep::settings {

// The bytes of a file by its name without folders ("fast.toml"); nothing when no such file is embedded.
std::optional<std::string_view> embedded_file(std::string_view name);

// In alphabetical order.
std::vector<std::string_view> embedded_file_names();

}  // namespace skysweep::settings
