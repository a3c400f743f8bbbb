// SPDX-License-Identifier: Apache-2.0
#include "scene/world/ground.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/random.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kGroundStream = 0x61;
// Each wave is this much shorter than the one before, and lower in the same proportion, so that all are equally steep.
constexpr double kShorter = 0.6;

struct SinCos {
  double sin, cos;
};

// To about 1e-15 for |angle| < 1e6: a third of the time of the library's, which every ray that meets ground would pay
// for. Reduction to +-pi/4 with pi/2 in two parts, then the Taylor series.
SinCos sin_cos(double angle) {
  constexpr double kHalfPiHigh = 0x1.921fb54400000p+0, kHalfPiLow = 0x1.0b4611a626331p-34;
  const int quarter = floor_int(angle * (2 / std::numbers::pi) + 0.5);
  const double x = (angle - quarter * kHalfPiHigh) - quarter * kHalfPiLow, x2 = x * x;
  double s =
      x * (1 - x2 * (1. / 6) *
                   (1 - x2 * (1. / 20) *
                            (1 - x2 * (1. / 42) *
                                     (1 - x2 * (1. / 72) *
                                              (1 - x2 * (1. / 110) * (1 - x2 * (1. / 156) * (1 - x2 * (1. / 210))))))));
  double c = 1 - x2 * (1. / 2) *
                     (1 - x2 * (1. / 12) *
                              (1 - x2 * (1. / 30) *
                                       (1 - x2 * (1. / 56) *
                                                (1 - x2 * (1. / 90) * (1 - x2 * (1. / 132) * (1 - x2 * (1. / 182)))))));
  if (quarter & 1) std::swap(s, c), c = -c;
  return quarter & 2 ? SinCos{-s, -c} : SinCos{s, c};
}

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
    const auto [sine, cosine] = sin_cos(angle);
    out.z += wave.amplitude_m * sine;
    out.slope = out.slope + (wave.amplitude_m * cosine) * wave.wave_number;
  }
  return out;
}

double Ground::shortest_wave_m() const { return 2 * std::numbers::pi / norm(waves_.back().wave_number); }

}  // namespace skysweep::scene
