// SPDX-License-Identifier: Apache-2.0
// The rows of a photograph are read one after the other while the camera moves on.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(RollingShutter& settings);

class RollingShutterEffect final : public RayEffect {
 public:
  RollingShutterEffect(const RollingShutter& settings, const Scene& scene, const std::vector<Shot>& shots);
  void bend(SampleBatch& batch) const override;

 private:
  double seconds_per_row_, middle_row_;
};

}  // namespace skysweep::scene
