// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/waves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "scene/world/terrain/direction.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kGroundStream = 0x61;
constexpr int kRollingWaves = 4;
// Each wave is this much shorter than the one before, and lower in the same proportion, so that all are equally steep.
constexpr double kShorter = 0.6;

}  // namespace

HeightSample Waves::at(Vec2d p) const {
  HeightSample out;
  for (const Wave& wave : waves_) {
    const double angle = dot(wave.wave_number, p) + wave.phase;
    out.z += wave.amplitude_m * std::sin(angle);
    out.slope = out.slope + (wave.amplitude_m * std::cos(angle)) * wave.wave_number;
  }
  return out;
}

HeightRange Waves::heights(const Box2d&) const {
  double sum = 0;
  for (const Wave& wave : waves_) sum += wave.amplitude_m;
  return {-sum, sum};
}

MeshPlan Waves::mesh_plan() const {
  constexpr double kPerWave = 24;
  MeshPlan plan;
  plan.spacing_m = shortest_wave_m() / kPerWave;
  return plan;
}

double Waves::curvature(const Box2d&) const {
  double sum = 0;
  for (const Wave& wave : waves_) sum += wave.amplitude_m * dot(wave.wave_number, wave.wave_number);
  return sum;
}

double Waves::shortest_wave_m() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Wave& wave : waves_) shortest = std::min(shortest, 2 * std::numbers::pi / norm(wave.wave_number));
  return shortest;
}

Waves rolling_waves(const Terrain& terrain, std::uint64_t seed) {
  Random random(mix64(seed) ^ kGroundStream);
  std::vector<Waves::Wave> waves;
  double sum = 0, weight = 1;
  for (int i = 0; i < kRollingWaves; ++i) {
    const double direction = random.uniform(0, 2 * std::numbers::pi);
    const double wave_number = 2 * std::numbers::pi / (terrain.wavelength_m * weight);
    waves.push_back({wave_number * Vec2d{std::cos(direction), std::sin(direction)}, weight,
                     random.uniform(0, 2 * std::numbers::pi)});
    sum += weight;
    weight *= kShorter;
  }
  for (Waves::Wave& wave : waves) wave.amplitude_m *= 0.5 * terrain.relief_m / sum;
  return Waves(std::move(waves));
}

Waves straight_waves(const SinusoidTerrain& shape, double relief_m, double wavelength_m) {
  const Vec2d wave_number = (2 * std::numbers::pi / wavelength_m) * direction_of(shape.azimuth_deg);
  return Waves({{wave_number, 0.5 * relief_m, -dot(wave_number, shape.center)}});
}

}  // namespace skysweep::scene
