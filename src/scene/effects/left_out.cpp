// SPDX-License-Identifier: Apache-2.0
// The effects of a build without effects (SKYSWEEP_EFFECTS=OFF).
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/effects/scene_effects.h"

namespace skysweep::scene {

std::unique_ptr<SceneEffects> make_effects(const Scene&, const std::vector<camera::Pose>&) { return nullptr; }

std::vector<EffectReport> nothing_runs() { return {}; }

Effects read_effects(const settings::TomlTable&) {
  throw usage_error("this program was built without effects: remove the tables [effects.*] from the scene");
}

nlohmann::ordered_json effects_json(const Effects&) { return nlohmann::ordered_json::object(); }

}  // namespace skysweep::scene
