// SPDX-License-Identifier: Apache-2.0
// The tables of a scene file that say what is written beside the photographs: [metadata] [truth] [ground_control], and
// the formats of photographs. docs/scenes.md, section "Photographs, metadata and truth", describes their keys.
#pragma once

#include <string>

#include "scene/scene.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

// `format`: the value of the key of this name in `table`. Throws Error(usage).
PhotoFormat read_photo_format(const settings::TomlTable& table, const std::string& format);

// Throws Error(usage).
void read_products(const settings::TomlTable& scene, Scene& out);

}  // namespace skysweep::scene
