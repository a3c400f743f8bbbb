// SPDX-License-Identifier: Apache-2.0
// Truth and products in scene.json.
#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.h"

namespace skysweep::scene {

void add_products_json(const Scene& scene, nlohmann::ordered_json& out);

}  // namespace skysweep::scene
