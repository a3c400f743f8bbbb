// SPDX-License-Identifier: Apache-2.0
// The texts of src/render/gpu/shaders/, embedded in the program (cmake/EmbedText.cmake).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace skysweep::render::on_gpu {

std::optional<std::string_view> embedded_file(std::string_view name);
std::vector<std::string_view> embedded_file_names();

}  // namespace skysweep::render::on_gpu
