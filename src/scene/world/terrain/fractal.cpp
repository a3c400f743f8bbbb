// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/fractal.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kFractalStream = 0x6f;
// Suprema over all choices of gradients, found by maximising the sum over the corners of the norm of each gradient's
// coefficient on a 60 x 60 grid of positions and 16 directions: of the noise (at the middle of a lattice cell, exact)
// and of its second derivative in any direction (9.23, rounded up for what lies between the grid).
constexpr double kNoiseBound = std::numbers::sqrt2 / 2;
constexpr double kSecondDerivativeBound = 9.4;

constexpr int kGradients = 64;
const std::array<Vec2d, kGradients>& gradients() {
  static const std::array<Vec2d, kGradients> table = [] {
    std::array<Vec2d, kGradients> out;
    for (int i = 0; i < kGradients; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / kGradients;
      out[static_cast<std::size_t>(i)] = {std::cos(angle), std::sin(angle)};
    }
    return out;
  }();
  return table;
}

double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t - 1) * (t - 1); }

// Noise with unit gradients at the points of the unit lattice.
HeightSample gradient_noise(Vec2d q, std::uint32_t seed) {
  const int i = floor_int(q.x), j = floor_int(q.y);
  const double x = q.x - i, y = q.y - j;
  const auto gradient = [&](int di, int dj) { return gradients()[lattice_hash(i + di, j + dj, seed) % kGradients]; };
  const Vec2d ga = gradient(0, 0), gb = gradient(1, 0), gc = gradient(0, 1), gd = gradient(1, 1);
  const double a = dot(ga, {x, y}), b = dot(gb, {x - 1, y}), c = dot(gc, {x, y - 1}), d = dot(gd, {x - 1, y - 1});
  const double sx = fade(x), sy = fade(y);
  const double south = a + sx * (b - a), north = c + sx * (d - c);
  const Vec2d south_slope = ga + sx * (gb - ga) + Vec2d{fade_slope(x) * (b - a), 0};
  const Vec2d north_slope = gc + sx * (gd - gc) + Vec2d{fade_slope(x) * (d - c), 0};
  return {south + sy * (north - south),
          south_slope + sy * (north_slope - south_slope) + Vec2d{0, fade_slope(y) * (north - south)}};
}

}  // namespace

Fractal::Fractal(const FractalTerrain& shape, double relief_m, double wavelength_m, std::uint64_t seed)
    : shortest_m_(wavelength_m * std::exp2(1 - shape.octaves)) {
  constexpr double kTurn = 0.65;  // radians from octave to octave
  Random random(mix64(seed) ^ kFractalStream);
  double weight = 1, size_m = wavelength_m;
  double turn = random.uniform(0, 2 * std::numbers::pi);
  for (int i = 0; i < shape.octaves; ++i) {
    octaves_.push_back({(1 / size_m) * Vec2d{std::cos(turn), std::sin(turn)},
                        {random.uniform(), random.uniform()},
                        weight,
                        static_cast<std::uint32_t>(random.next())});
    sum_m_ += kNoiseBound * weight;
    weight *= shape.roughness;
    size_m *= 0.5;
    turn += kTurn;
  }
  const double scale = 0.5 * relief_m / sum_m_;
  sum_m_ = 0.5 * relief_m;
  for (Octave& octave : octaves_) {
    octave.amplitude_m *= scale;
    curvature_ += kSecondDerivativeBound * octave.amplitude_m * dot(octave.axis, octave.axis);
  }
}

HeightSample Fractal::at(Vec2d p) const {
  HeightSample out;
  for (const Octave& octave : octaves_) {
    const Vec2d left{-octave.axis.y, octave.axis.x};
    const HeightSample noise = gradient_noise(Vec2d{dot(p, octave.axis), dot(p, left)} + octave.shift, octave.seed);
    out.z += octave.amplitude_m * noise.z;
    out.slope = out.slope + octave.amplitude_m * (noise.slope.x * octave.axis + noise.slope.y * left);
  }
  return out;
}

HeightRange Fractal::heights(const Box2d&) const { return {-sum_m_, sum_m_}; }

MeshPlan Fractal::mesh_plan() const {
  constexpr double kPerOctave = 8;
  MeshPlan plan;
  plan.spacing_m = shortest_m_ / kPerOctave;
  return plan;
}

}  // namespace skysweep::scene
