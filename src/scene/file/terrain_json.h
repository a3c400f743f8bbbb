// SPDX-License-Identifier: Apache-2.0
// Ground and texture in scene.json.
#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.h"

namespace skysweep::scene {

nlohmann::ordered_json terrain_json(const Terrain& terrain);
nlohmann::ordered_json texture_json(const Scene& scene);

}  // namespace skysweep::scene
