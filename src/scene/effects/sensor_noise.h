// SPDX-License-Identifier: Apache-2.0
// Shot noise of the light and read noise of the sensor, as they grow with the ISO number.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(SensorNoise& settings);

class SensorNoiseEffect final : public ImageEffect {
 public:
  SensorNoiseEffect(const SensorNoise& settings, const Scene& scene, const std::vector<Shot>& shots);
  void develop(const Shot& shot, int row, LinearRgb* pixels, int width) const override;

 private:
  double electrons_of_white_, read_variance_;
  std::uint64_t seed_;
};

}  // namespace skysweep::scene
