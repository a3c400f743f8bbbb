// SPDX-License-Identifier: Apache-2.0
// The tables [terrain], [[terrain.modification]] and [texture] of a scene file.
#pragma once

#include <filesystem>

#include "scene/scene.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

// `area_m`: the mapped area; shapes that name no centre have it in its middle. Throw Error(usage) naming file, line and
// key.
Terrain read_terrain(const settings::TomlTable& table, Vec2d area_m);
Texture read_texture(const settings::TomlTable& table);

// Names of files in a scene file are relative to its folder.
void resolve_files(Scene& scene, const std::filesystem::path& folder);

}  // namespace skysweep::scene
