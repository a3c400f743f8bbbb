// SPDX-License-Identifier: Apache-2.0
// The table [effects] of a scene file, to and fro.
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/effects/catalogue.h"
#include "scene/effects/scene_effects.h"

namespace skysweep::scene {
namespace {

// Effects whose outcome depends on how fast the aircraft flies.
bool time_matters(const Effects& e) {
  return e.time_jitter || e.rolling_shutter || e.motion_blur || e.cloud_shadows || e.moving_cars || e.specular_water;
}

}  // namespace

Effects read_effects(const settings::TomlTable& table) {
  Effects out;
  for_each_effect(out, [&](const EffectInfo& info, auto& settings, auto) {
    const std::optional<settings::TomlTable> own = table.table(info.name);
    if (!own) return;
    settings.emplace();
    settings->named_at = table.where(info.name);
    read_dials(*own, settings->named_at, dials(*settings));
  });
  read_dials(table, "effects", {{"speed_mps", &out.speed_mps, kAboveZero, 1000}});
  if (table.has("speed_mps") && !time_matters(out))
    throw usage_error(table.where("speed_mps") +
                      " has no effect: none of time_jitter, rolling_shutter, motion_blur, cloud_shadows, moving_cars "
                      "and specular_water is named; remove it");
  return out;
}

nlohmann::ordered_json effects_json(const Effects& effects) {
  auto out = nlohmann::ordered_json::object();
  if (time_matters(effects)) out["speed_mps"] = effects.speed_mps;
  Effects copy = effects;
  for_each_effect(copy, [&](const EffectInfo& info, auto& settings, auto) {
    if (!settings) return;
    auto& own = out[info.name];
    for (const Dial& dial : dials(*settings)) {
      if (double* const* number = std::get_if<double*>(&dial.value)) {
        own[dial.key] = **number;
      } else {
        const Vec3d& color = *std::get<Vec3d*>(dial.value);
        own[dial.key] = {color.x, color.y, color.z};
      }
    }
  });
  return out;
}

}  // namespace skysweep::scene
