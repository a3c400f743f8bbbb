// SPDX-License-Identifier: Apache-2.0
// Air that takes light on the way to the camera and adds its own (Koschmieder 1924).
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(Haze& settings);

class HazeEffect final : public AirEffect {
 public:
  HazeEffect(const Haze& settings, const Scene& scene, const std::vector<Shot>& shots);
  void dim(const Ray* rays, const SurfacePoint* hits, int count, LinearRgb* light) const override;

 private:
  double extinction_per_m_;
  LinearRgb air_;
};

}  // namespace skysweep::scene
