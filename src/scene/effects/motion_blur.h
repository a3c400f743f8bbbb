// SPDX-License-Identifier: Apache-2.0
// The camera moves while the shutter is open.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(MotionBlur& settings);

class MotionBlurEffect final : public RayEffect {
 public:
  MotionBlurEffect(const MotionBlur& settings, const Scene& scene, const std::vector<Shot>& shots);
  int rounds() const override { return rounds_; }
  void bend(SampleBatch& batch) const override;

 private:
  double exposure_s_;
  int rounds_;
};

}  // namespace skysweep::scene
