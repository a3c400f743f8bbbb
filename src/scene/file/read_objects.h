// SPDX-License-Identifier: Apache-2.0
// The tables of a scene file that put things on the ground: [town] [[building]] [[tree]] [forest] [[wall]] [[bridge]]
// [[mast]] [[power_line]]. docs/scenes.md, section "Objects", describes their keys. All throw Error(usage).
#pragma once

#include <string>

#include "scene/objects.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

// `file`: the name of the scene file, for messages about what is missing.
Town read_town(const settings::TomlTable& table);
Building read_building(const settings::TomlTable& table, const std::string& file);
// From the tables of the whole scene file.
Things read_things(const settings::TomlTable& scene, const std::string& file);

}  // namespace skysweep::scene
