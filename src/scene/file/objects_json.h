// SPDX-License-Identifier: Apache-2.0
// Objects as JSON, with the keys of scene files. What is off by default is there only if the scene turns it on.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "scene/objects.h"

namespace skysweep::scene {

nlohmann::ordered_json town_json(const Town& town);
nlohmann::ordered_json buildings_json(const std::vector<Building>& buildings);
// Adds one key for each kind of thing there is to the JSON of the scene.
void add_things(const Things& things, nlohmann::ordered_json& scene);

}  // namespace skysweep::scene
