// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/exposure_drift.h"

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "scene/effects/drift.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kExposureDriftStream = 0xeffe4d;

}  // namespace

std::vector<Dial> dials(ExposureDrift& s) {
  return {{"stops", &s.stops, 0, 5},
          {"white_balance", &s.white_balance, 0, 1},
          {"correlation_photographs", &s.correlation_photographs, kAboveZero}};
}

ExposureDriftEffect::ExposureDriftEffect(const ExposureDrift& settings, const Scene& scene,
                                         const std::vector<Shot>& shots)
    : ImageEffect(EffectId::exposure_drift) {
  if (settings.stops == 0 && settings.white_balance == 0)
    throw usage_error(settings.named_at + " has no effect: set stops or white_balance above 0, or leave the table out");
  const std::uint64_t seed = mix64(scene.seed) ^ kExposureDriftStream;
  const int count = static_cast<int>(shots.size());
  const std::vector<double> exposure = drift(count, settings.correlation_photographs, seed);
  const std::vector<double> warmth = drift(count, settings.correlation_photographs, mix64(seed));
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const double gain = std::exp2(settings.stops * exposure[i]);
    const double warm = std::exp(settings.white_balance * warmth[i]);
    gains_.push_back({static_cast<float>(gain * warm), static_cast<float>(gain), static_cast<float>(gain / warm)});
  }
}

void ExposureDriftEffect::develop(const Shot& shot, int, LinearRgb* pixels, int width) const {
  const LinearRgb g = gain(shot.index);
  for (int i = 0; i < width; ++i) pixels[i] = {g.r * pixels[i].r, g.g * pixels[i].g, g.b * pixels[i].b};
}

}  // namespace skysweep::scene
