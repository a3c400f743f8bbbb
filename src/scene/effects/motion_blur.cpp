// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/motion_blur.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skysweep::scene {
namespace {

constexpr int kMostRounds = 16;

// A step through 0 .. count - 1 that meets every number, far from the one before: the order of the samples in time has
// nothing to do with their order in the pixel or on the lens.
int step_through(int count) {
  int step = std::max(1, static_cast<int>(0.618 * count));
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

}  // namespace

std::vector<Dial> dials(MotionBlur& s) { return {{"exposure_s", &s.exposure_s, kAboveZero, 10, true}}; }

MotionBlurEffect::MotionBlurEffect(const MotionBlur& settings, const Scene& scene, const std::vector<Shot>&)
    : RayEffect(EffectId::motion_blur), exposure_s_(settings.exposure_s) {
  // Four samples for each pixel of blur.
  const double blur_px = settings.exposure_s * scene.effects.speed_mps / scene.flight.gsd_m;
  rounds_ = static_cast<int>(std::clamp(std::ceil(blur_px), 1.0, static_cast<double>(kMostRounds)));
}

void MotionBlurEffect::bend(SampleBatch& batch) const {
  const int samples = batch.samples(), step = step_through(samples);
  for (int i = 0; i < batch.count; ++i) {
    const int turn = batch.sample(i) * step % samples;
    batch.time_s[static_cast<std::size_t>(i)] += ((turn + 0.5) / samples - 0.5) * exposure_s_;
  }
}

}  // namespace skysweep::scene
