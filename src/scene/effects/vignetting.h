// SPDX-License-Identifier: Apache-2.0
// A lens gives its corners less light.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(Vignetting& settings);

class VignettingEffect final : public ImageEffect {
 public:
  VignettingEffect(const Vignetting& settings, const Scene& scene, const std::vector<Shot>& shots);
  void develop(const Shot& shot, int row, LinearRgb* pixels, int width) const override;

 private:
  camera::CameraModel camera_;
  std::vector<float> factor_;  // over the squared distance from the principal point, normalised, distorted
  double per_step_;
};

}  // namespace skysweep::scene
