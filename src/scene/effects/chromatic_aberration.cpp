// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/chromatic_aberration.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace skysweep::scene {

std::vector<Dial> dials(ChromaticAberration& s) {
  return {{"red_px", &s.red_px, -100, 100}, {"blue_px", &s.blue_px, -100, 100}};
}

ChromaticAberrationEffect::ChromaticAberrationEffect(const ChromaticAberration& settings, const Scene& scene,
                                                     const std::vector<Shot>&)
    : RayEffect(EffectId::chromatic_aberration) {
  if (settings.red_px == 0 && settings.blue_px == 0)
    throw usage_error(settings.named_at + " has no effect: set red_px or blue_px, or leave the table out");
  const camera::CameraModel& c = scene.camera;
  const double corner_px =
      std::hypot(std::max(c.cx_px, c.width_px - c.cx_px), std::max(c.cy_px, c.height_px - c.cy_px));
  shrink_ = {1 / (1 + settings.red_px / corner_px), 1, 1 / (1 + settings.blue_px / corner_px)};
  if (std::max(std::abs(settings.red_px), std::abs(settings.blue_px)) > 0.1 * corner_px)
    throw usage_error(settings.named_at + " is stronger than a tenth of the photograph: lower red_px and blue_px");
}

void ChromaticAberrationEffect::bend(SampleBatch& batch) const {
  const double shrink = shrink_[static_cast<std::size_t>(batch.channel)];
  for (int i = 0; i < batch.count; ++i) {
    Vec3d& direction = batch.direction[static_cast<std::size_t>(i)];
    direction = {shrink * direction.x, shrink * direction.y, direction.z};
  }
}

}  // namespace skysweep::scene
