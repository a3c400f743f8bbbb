// SPDX-License-Identifier: Apache-2.0
// Automatic exposure and white balance that wander over the flight.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(ExposureDrift& settings);

class ExposureDriftEffect final : public ImageEffect {
 public:
  // Throws Error(usage) if both strengths are zero.
  ExposureDriftEffect(const ExposureDrift& settings, const Scene& scene, const std::vector<Shot>& shots);
  void develop(const Shot& shot, int row, LinearRgb* pixels, int width) const override;

  LinearRgb gain(int photograph) const { return gains_[static_cast<std::size_t>(photograph)]; }

 private:
  std::vector<LinearRgb> gains_;
};

}  // namespace skysweep::scene
