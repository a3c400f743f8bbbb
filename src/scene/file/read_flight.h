// SPDX-License-Identifier: Apache-2.0
// The tables [camera] and [flight] (or several [[flight]]) of a scene file. docs/scenes.md, section "Camera and
// flight", describes their keys.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

// Fills in camera and flights; origin and area must be known already. `folder`: what a file of poses is relative to;
// `file`: the name of the scene file, for messages. Without [camera] the flight of a file of poses has the camera that
// the file gives. Throws Error(usage) for wrong values, Error(bad_input) for a file of poses that cannot be read.
void read_camera_and_flights(const settings::TomlTable& scene, const std::filesystem::path& folder,
                             const std::string& file, Scene& out);

}  // namespace skysweep::scene
