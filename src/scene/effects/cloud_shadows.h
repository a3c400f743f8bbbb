// SPDX-License-Identifier: Apache-2.0
// Shadows of clouds that travel over the ground with the wind.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(CloudShadows& settings);

class CloudShadowsEffect final : public LightEffect {
 public:
  CloudShadowsEffect(const CloudShadows& settings, const Scene& scene, const std::vector<Shot>& shots);
  void change(const Shot& shot, const World& world, Moment& moment) const override;

  // Part of the sun's light, 0 to 1, that a cloud takes at a place of the layer of clouds, before the wind moves it.
  double taken_at(Vec2d place) const;
  const CloudShadows& settings() const { return settings_; }

 private:
  double thickness(Vec2d place) const;

  CloudShadows settings_;
  std::uint32_t seed_;
  double edge_ = 0;  // thickness at the rim of the clouds
};

}  // namespace skysweep::scene
