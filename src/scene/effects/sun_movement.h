// SPDX-License-Identifier: Apache-2.0
// The sun goes on while the photographs are taken: shadows turn from one to the next.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(SunMovement& settings);

// Direction to the sun `hours` later, at a latitude: the sky turns about the celestial pole by 15 degrees an hour.
Vec3d sun_after(Vec3d towards_sun, double hours, double latitude_deg);

class SunMovementEffect final : public LightEffect {
 public:
  // Throws Error(usage) if the sun would be below 2 degrees at the first or the last photograph.
  SunMovementEffect(const SunMovement& settings, const Scene& scene, const std::vector<Shot>& shots);
  void change(const Shot& shot, const World& world, Moment& moment) const override;

 private:
  double hours_at(double time_s) const;  // since the middle of the flight

  SunMovement settings_;
  double duration_s_;
};

}  // namespace skysweep::scene
