// SPDX-License-Identifier: Apache-2.0
// Noise that is addressed by position: the same place always has the same value, and none repeats.
#pragma once

#include <cmath>
#include <cstdint>

namespace skysweep::scene {

// 32 well-mixed bits of a lattice point (constants of Wellons' "lowbias32").
inline std::uint32_t lattice_hash(int x, int y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u + static_cast<std::uint32_t>(y) * 0x85ebca77u + seed;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

// Uniform in [-1, 1).
inline float lattice_value(int x, int y, std::uint32_t seed) {
  return static_cast<float>(static_cast<std::int32_t>(lattice_hash(x, y, seed))) * 0x1p-31f;
}

inline int floor_int(double v) {
  const int i = static_cast<int>(v);
  return i - (v < i);
}

// Lattice values blended smoothly, in [-1, 1].
inline float value_noise(double x, double y, std::uint32_t seed) {
  const int i = floor_int(x), j = floor_int(y);
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  const float sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
  const float a = lattice_value(i, j, seed), b = lattice_value(i + 1, j, seed);
  const float c = lattice_value(i, j + 1, seed), d = lattice_value(i + 1, j + 1, seed);
  const float south = a + sx * (b - a), north = c + sx * (d - c);
  return south + sy * (north - south);
}

}  // namespace skysweep::scene
