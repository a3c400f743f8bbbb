// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/sky_light.h"

#include "core/error.h"

namespace skysweep::scene {

std::vector<Dial> dials(SkyLight& s) { return {{"strength", &s.strength, 0, 100}, {"color", &s.color, 0, 100}}; }

SkyLightEffect::SkyLightEffect(const SkyLight& settings, const Scene&, const std::vector<Shot>&)
    : LightEffect(EffectId::sky), settings_(settings) {
  if (settings.strength * settings.color == Vec3d{1, 1, 1})
    throw usage_error(settings.named_at +
                      " has no effect: set a strength or color other than 1, or leave the table out");
}

void SkyLightEffect::change_always(Moment& moment) const {
  const Vec3d factor = settings_.strength * settings_.color;
  moment.sky = {static_cast<float>(factor.x) * moment.sky.r, static_cast<float>(factor.y) * moment.sky.g,
                static_cast<float>(factor.z) * moment.sky.b};
}

}  // namespace skysweep::scene
