// SPDX-License-Identifier: Apache-2.0
#include "scene/world/ground.h"

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kGroundStream = 0x61;
// Each wave is this much shorter than the one before, and lower in the same proportion, so that all are equally steep.
constexpr double kShorter = 0.6;

}  // namespace

Ground::Ground(const Terrain& terrain, std::uint64_t seed) : level_(terrain.relief_m == 0) {
  Random random(mix64(seed) ^ kGroundStream);
  double sum = 0, weight = 1;
  for (Wave& wave : waves_) {
    const double direction = random.uniform(0, 2 * std::numbers::pi);
    const double wave_number = 2 * std::numbers::pi / (terrain.wavelength_m * weight);
    wave = {wave_number * Vec2d{std::cos(direction), std::sin(direction)}, weight,
            random.uniform(0, 2 * std::numbers::pi)};
    sum += weight;
    weight *= kShorter;
  }
  for (Wave& wave : waves_) wave.amplitude_m *= 0.5 * terrain.relief_m / sum;
}

Ground::Sample Ground::at(Vec2d p) const {
  Sample out;
  if (level_) return out;
  for (const Wave& wave : waves_) {
    const double angle = dot(wave.wave_number, p) + wave.phase;
    out.z += wave.amplitude_m * std::sin(angle);
    out.slope = out.slope + (wave.amplitude_m * std::cos(angle)) * wave.wave_number;
  }
  return out;
}

double Ground::shortest_wave_m() const { return 2 * std::numbers::pi / norm(waves_.back().wave_number); }

}  // namespace skysweep::scene
