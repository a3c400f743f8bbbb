// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/water_waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr double kCalm = 0.003, kPerWind = 0.00512;  // of Cox & Munk's mean square slope
constexpr double kGravity = 9.81;
constexpr double kShortest_m = 0.017;  // there gravity and surface tension act alike
constexpr double kLongest_m = 3;       // what a lake has room to raise
constexpr double kPixelsPerWave = 3;
constexpr int kWaves = 24;

// No wave outruns the wind that raises it.
double longest_wave_m(double wind_mps) {
  return std::min(kLongest_m, 2 * std::numbers::pi * wind_mps * wind_mps / kGravity);
}

}  // namespace

double mean_square_slope(double wind_mps) { return kCalm + kPerWind * wind_mps; }

WaterWaves::WaterWaves(double wind_mps, double wind_from_deg, double gsd_m, std::uint64_t seed) {
  const double longest = longest_wave_m(wind_mps), finest_seen = std::max(kShortest_m, kPixelsPerWave * gsd_m);
  if (finest_seen < longest)
    seen_variance_ = kPerWind * wind_mps * std::log(longest / finest_seen) / std::log(longest / kShortest_m);
  fine_variance_ = mean_square_slope(wind_mps) - seen_variance_;
  if (!(seen_variance_ > 0)) return;

  const double downwind = (wind_from_deg + 180) * std::numbers::pi / 180;
  Random random(seed);
  const double turn = random.uniform();
  for (int i = 0; i < kWaves; ++i) {
    const double length = finest_seen * std::pow(longest / finest_seen, (i + random.uniform()) / kWaves);
    // Evenly to all sides that are not against the wind; the golden ratio keeps neighbours in length apart.
    const double share = std::fmod(turn + i * std::numbers::phi, 1.0);
    const double towards = downwind + (share - 0.5) * std::numbers::pi;
    const Vec2d along{std::sin(towards), std::cos(towards)};
    const double per_m = 2 * std::numbers::pi / length;
    const double phase = random.uniform(0, 2 * std::numbers::pi);
    waves_.push_back(
        {per_m * along, std::sqrt(kGravity * per_m), phase, std::sqrt(2 * seen_variance_ / kWaves) * along});
  }
}

Vec2d WaterWaves::slope(Vec2d place, double time_s) const {
  Vec2d sum;
  for (const Wave& wave : waves_)
    sum = sum + std::cos(dot(wave.per_m, place) - wave.per_s * time_s + wave.phase) * wave.slope;
  return sum;
}

}  // namespace skysweep::scene
