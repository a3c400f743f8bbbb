// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/defocus.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skysweep::scene {
namespace {

constexpr int kMostRounds = 16;
const double kGoldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));

}  // namespace

std::vector<Dial> dials(Defocus& s) {
  return {{"aperture_mm", &s.aperture_mm, kAboveZero, 1000, true},
          {"focus_distance_m", &s.focus_distance_m, kAboveZero, kNoLimit, true}};
}

double blur_disc_px(const Defocus& settings, double focal_px, double distance_m) {
  return focal_px * 1e-3 * settings.aperture_mm * std::abs(1 / settings.focus_distance_m - 1 / distance_m);
}

DefocusEffect::DefocusEffect(const Defocus& settings, const Scene& scene, const std::vector<Shot>&)
    : RayEffect(EffectId::defocus),
      radius_m_(0.5e-3 * settings.aperture_mm),
      per_focus_distance_(1 / settings.focus_distance_m) {
  // Four samples for each pixel that the disc covers.
  const double disc = blur_disc_px(settings, scene.camera.focal_px(), scene.altitude_m());
  rounds_ = static_cast<int>(std::clamp(std::ceil(0.785 * disc * disc), 1.0, static_cast<double>(kMostRounds)));
}

// All rays of a pixel that leave the lens meet at the focus distance. Points on the lens: Vogel's spiral (1979).
void DefocusEffect::bend(SampleBatch& batch) const {
  for (int i = 0; i < batch.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int sample = batch.sample(i);
    const double radius = radius_m_ * std::sqrt((sample + 0.5) / batch.samples());
    const Vec3d on_lens{radius * std::cos(sample * kGoldenAngle), radius * std::sin(sample * kGoldenAngle), 0};
    batch.offset[at] = batch.offset[at] + on_lens;
    batch.direction[at] = batch.direction[at] - per_focus_distance_ * on_lens;
  }
}

}  // namespace skysweep::scene
