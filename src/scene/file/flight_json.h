// SPDX-License-Identifier: Apache-2.0
// Camera and flights in scene.json.
#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.h"

namespace skysweep::scene {

nlohmann::ordered_json camera_json(const camera::CameraModel& camera);
// One flight as an object, several as an array of objects.
nlohmann::ordered_json flights_json(const Scene& scene);

}  // namespace skysweep::scene
