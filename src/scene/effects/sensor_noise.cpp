// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/sensor_noise.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kSensorStream = 0xeff5e0;

}  // namespace

std::vector<Dial> dials(SensorNoise& s) {
  return {{"iso", &s.iso, 25, 409600, true},
          {"full_well_e", &s.full_well_e, 100, 1e7},
          {"read_noise_e", &s.read_noise_e, 0, 1000}};
}

SensorNoiseEffect::SensorNoiseEffect(const SensorNoise& settings, const Scene& scene, const std::vector<Shot>&)
    : ImageEffect(EffectId::sensor_noise),
      electrons_of_white_(settings.full_well_e * 100 / settings.iso),
      read_variance_(settings.read_noise_e * settings.read_noise_e),
      seed_(mix64(scene.seed) ^ kSensorStream) {}

// Poisson's law is taken as a normal one of the same mean and variance; its sum with the read noise is normal again.
void SensorNoiseEffect::develop(const Shot& shot, int row, LinearRgb* pixels, int width) const {
  const std::uint64_t row_seed =
      mix64(seed_ ^ mix64(static_cast<std::uint64_t>(shot.index) << 32 | static_cast<std::uint32_t>(row)));
  for (int column = 0; column < width; ++column) {
    Random random(row_seed + static_cast<std::uint64_t>(column));
    for (float* v : {&pixels[column].r, &pixels[column].g, &pixels[column].b}) {
      const double electrons = std::max(0.0, *v * electrons_of_white_);
      *v = static_cast<float>((electrons + std::sqrt(electrons + read_variance_) * random.normal()) /
                              electrons_of_white_);
    }
  }
}

}  // namespace skysweep::scene
