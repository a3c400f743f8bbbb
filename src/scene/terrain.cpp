// SPDX-License-Identifier: Apache-2.0
#include "scene/terrain.h"

#include <array>
#include <cmath>
#include <numbers>

namespace skysweep::scene {

double QuarryTerrain::margin_m() const {
  const double face_m = height_m / std::tan(face_deg * std::numbers::pi / 180);
  return steps * face_m + (steps - 1) * bench_m;
}

double QuarryTerrain::corner_radius_m() const {
  constexpr double kLeast_m = 1.5;  // at the foot of the lowest face
  return margin_m() + break_width_m + kLeast_m;
}

TerrainModification crater(Vec2d center, Vec2d size_m, double depth_m) {
  constexpr int kSide = 9, kMiddle = kSide / 2;  // one value at each whole r from -4 to 4
  TerrainModification out{center, size_m, kSide, kSide, {}};
  for (int y = -kMiddle; y <= kMiddle; ++y)
    for (int x = -kMiddle; x <= kMiddle; ++x) out.heights_m.push_back(-depth_m * std::exp(-0.5 * (x * x + y * y)));
  return out;
}

std::string kind_name(const Terrain& terrain) {
  constexpr std::array<const char*, std::variant_size_v<decltype(Terrain::shape)>> kNames = {
      "rolling", "plane", "ramp", "step", "terraces", "sinusoid", "fractal", "quarry", "island", "dem"};
  return kNames[terrain.shape.index()];
}

}  // namespace skysweep::scene
