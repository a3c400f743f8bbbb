// SPDX-License-Identifier: Apache-2.0
// Scenes as TOML files; config/scenes/ holds examples. The keys are the members of the structs in scene/scene.h:
//
//   seed, origin = [x, y, z], crs, area_m = [width, height]
//   [terrain] [[terrain.modification]] [town] [[building]] [[tree]] [forest] [[wall]] [[bridge]] [[mast]]
//   [[power_line]] [texture] [light] [camera] [flight] or [[flight]] [photographs] [metadata] [truth] [ground_control]
//   [effects.NAME] for each effect that is wanted: NAME and keys are the members of scene/effect_settings.h
//
// [terrain] kind and [texture] kind say which further keys these tables have. Files that a scene names are relative to
// its own folder.
//
// docs/scenes.md lists all keys. [camera] is width_px, height_px, focal_px and, if wanted, focal_y_px,
// principal_point_px = [cx, cy] and distortion = [k1, k2, p1, p2, k3]. [town] present means a town; everything absent
// has the default of its member.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace skysweep::scene {

// Throws Error(usage) naming file, line and key: wrong values, unknown keys.
Scene read_scene(const std::filesystem::path& path);

// The same from text; `name` stands for the file in messages.
Scene parse_scene(const std::string& text, const std::string& name);

// All parameters as JSON, with what depends on others resolved.
std::string scene_to_json(const Scene& scene);

}  // namespace skysweep::scene
