// SPDX-License-Identifier: Apache-2.0
// How bright the sky is beside the sun, and of which colour. It is the light of the place: the truth shows it too.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(SkyLight& settings);

class SkyLightEffect final : public LightEffect {
 public:
  // Throws Error(usage) if it is the sky that a scene has anyway.
  SkyLightEffect(const SkyLight& settings, const Scene& scene, const std::vector<Shot>& shots);
  void change_always(Moment& moment) const override;

 private:
  SkyLight settings_;
};

}  // namespace skysweep::scene
