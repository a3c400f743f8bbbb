// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/haze.h"

#include <cmath>

namespace skysweep::scene {
namespace {

constexpr double kThresholdOfSight = 0.02;  // contrast at the meteorological range

}  // namespace

std::vector<Dial> dials(Haze& s) {
  return {{"visibility_m", &s.visibility_m, kAboveZero, 1e6, true}, {"color", &s.color, 0, 1}};
}

HazeEffect::HazeEffect(const Haze& settings, const Scene&, const std::vector<Shot>&)
    : AirEffect(EffectId::haze),
      extinction_per_m_(-std::log(kThresholdOfSight) / settings.visibility_m),
      air_{static_cast<float>(settings.color.x), static_cast<float>(settings.color.y),
           static_cast<float>(settings.color.z)} {}

void HazeEffect::dim(const Ray* rays, const SurfacePoint* hits, int count, LinearRgb* light) const {
  for (int i = 0; i < count; ++i) {
    const bool nothing = hits[i].face == Face::none;
    const double way_m = nothing ? 0 : norm(hits[i].position - rays[i].origin);
    const float kept = nothing ? 0 : static_cast<float>(std::exp(-extinction_per_m_ * way_m));
    light[i] = kept * light[i] + (1 - kept) * air_;
  }
}

}  // namespace skysweep::scene
