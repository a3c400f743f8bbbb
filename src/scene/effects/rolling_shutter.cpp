// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/rolling_shutter.h"

namespace skysweep::scene {

std::vector<Dial> dials(RollingShutter& s) { return {{"readout_s", &s.readout_s, kAboveZero, 10, true}}; }

RollingShutterEffect::RollingShutterEffect(const RollingShutter& settings, const Scene& scene, const std::vector<Shot>&)
    : RayEffect(EffectId::rolling_shutter),
      seconds_per_row_(settings.readout_s / scene.camera.height_px),
      middle_row_(0.5 * scene.camera.height_px) {}

void RollingShutterEffect::bend(SampleBatch& batch) const {
  const double time_s = (batch.row + 0.5 - middle_row_) * seconds_per_row_;
  for (int i = 0; i < batch.count; ++i) batch.time_s[static_cast<std::size_t>(i)] += time_s;
}

}  // namespace skysweep::scene
