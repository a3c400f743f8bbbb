// SPDX-License-Identifier: Apache-2.0
// One terrain of every kind, as steep and rough as scenes have them.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "scene/terrain.h"
#include "scene/world/terrain/height_grid.h"

namespace skysweep::scene {

inline Terrain shaped(decltype(Terrain::shape) shape, double relief_m = 0, double wavelength_m = 60) {
  Terrain out;
  out.shape = std::move(shape);
  out.relief_m = relief_m;
  out.wavelength_m = wavelength_m;
  return out;
}

inline std::vector<std::pair<std::string, Terrain>> terrains_of_every_kind() {
  constexpr Vec2d kMiddle{50, 50};
  std::vector<std::pair<std::string, Terrain>> out = {
      {"plane", shaped(PlaneTerrain{25, 37, kMiddle})},
      {"ramp", shaped(RampTerrain{35, 20, 0, 70, kMiddle})},
      {"rounded ramp", shaped(RampTerrain{35, 20, 3, 70, kMiddle})},
      {"step", shaped(StepTerrain{4, 84, 15, kMiddle})},
      {"terraces", shaped(TerracesTerrain{4, 3, 5, 75, 200, kMiddle})},
      {"sinusoid", shaped(SinusoidTerrain{120, kMiddle}, 6, 25)},
      {"fractal", shaped(FractalTerrain{6, 0.55}, 30, 50)},
      {"quarry", shaped(QuarryTerrain{kMiddle, {50, 44}, 20, 3, 4, 3, 75, 0.4})},
      {"island", shaped(IslandTerrain{kMiddle, 35, 12, 5, 6, 4})},
      {"terraces on rolling ground", shaped(TerracesTerrain{3, 2, 6, 70, 90, kMiddle}, 2, 30)},
  };
  for (auto& [name, terrain] : out)
    if (name == "island") terrain.water_level_m = 0;
  Terrain cratered = shaped(PlaneTerrain{10, 90, kMiddle});
  cratered.modifications = {crater({45, 52}, {20, 16}, 3), {{60, 50}, {6, 4}, 3, 2, {1, 2, 1.5, -1, 0.5, 2}}};
  out.emplace_back("craters on a plane", cratered);
  // As steep and broken as a DEM of a town: heights without any relation, one a metre.
  Terrain rubble;
  TerrainModification matrix{kMiddle, {40, 40}, 41, 41, {}};
  Random random(8);
  for (int i = 0; i < 41 * 41; ++i) matrix.heights_m.push_back(random.uniform(0, 5));
  rubble.modifications = {matrix};
  out.emplace_back("rubble", rubble);
  Terrain flooded = shaped(QuarryTerrain{kMiddle, {50, 44}, 20, 3, 4, 3, 75, 0.4});
  flooded.water_level_m = -9.5;
  out.emplace_back("flooded quarry", flooded);
  return out;
}

}  // namespace skysweep::scene
