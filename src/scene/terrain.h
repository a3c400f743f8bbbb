// SPDX-License-Identifier: Apache-2.0
// The bare ground of a synthetic scene. Heights are those of the scene's frame. Every kind of ground is a closed form:
// height and slope are known at every point in double, none is ever read off a mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/vec.h"

namespace skysweep::scene {

// A plane that rises towards `azimuth_deg` (clockwise from north); z = 0 at `center`.
struct PlaneTerrain {
  double slope_deg = 10;
  double azimuth_deg = 90;
  Vec2d center;
};

// Level ground, a slope of `length_m` in plan, level ground: half the rise below z = 0, half above; `center` is the
// middle of the slope. At the foot and at the brink the slope changes over `break_width_m` in plan (0: sharply).
struct RampTerrain {
  double slope_deg = 20;
  double length_m = 20;
  double break_width_m = 0;
  double azimuth_deg = 90;  // uphill
  Vec2d center;
};

// Two levels, `height_m` apart, either side of z = 0, and a steep face between them through `center`.
struct StepTerrain {
  double height_m = 3;
  double face_deg = 80;  // from the horizontal
  double azimuth_deg = 90;
  Vec2d center;
};

// A hillside of benches: from level ground at z = 0, whose edge is `center`, up `steps` faces with benches between.
struct TerracesTerrain {
  int steps = 4;
  double height_m = 2;  // of each face
  double bench_m = 8;   // width of each bench
  double face_deg = 70;
  double azimuth_deg = 90;
  Vec2d center;
};

// Waves with straight crests; `relief_m` and `wavelength_m` of Terrain. z = 0, rising, at `center`.
struct SinusoidTerrain {
  double azimuth_deg = 90;
  Vec2d center;
};

// Octaves of gradient noise: the longest has the size `wavelength_m` of Terrain, each further one half that size and
// `roughness` times the height. `relief_m` of Terrain bounds highest minus lowest.
struct FractalTerrain {
  int octaves = 7;
  double roughness = 0.5;
};

// An open pit in ground at z = 0: `steps` faces down, with benches between. In plan a rectangle with round corners.
struct QuarryTerrain {
  Vec2d center;
  Vec2d size_m{44, 36};    // of the pit's rim, before turning by the heading
  double heading_deg = 0;  // turned clockwise
  int steps = 3;
  double height_m = 4;  // of each face
  double bench_m = 3;   // width of each bench
  double face_deg = 72;
  double break_width_m = 0.4;  // over which edges are rounded

  double deepest_m() const { return steps * height_m; }
  double margin_m() const;         // from the rim to the foot of the lowest face, in plan
  double corner_radius_m() const;  // of the rim: just enough that the lowest corner is round
};

// An island with a fractal coast: a seeded Koch curve about `center` (Rommel 2008: Koch-curve outlines), sampled on a
// fine lattice and interpolated smoothly. The shore is at z = 0, where the water level is by default.
struct IslandTerrain {
  Vec2d center;
  double radius_m = 35;    // of the triangle's corners; the coast reaches a little beyond
  double height_m = 12;    // of the ground far from the shore, hills apart
  double sea_depth_m = 5;  // far from the shore
  double hills_m = 6;      // bound on the relief of fractal hills, which fade out towards the shore
  int koch_depth = 4;      // subdivisions of the coast
};

// Heights of a raster that GDAL reads (GeoTIFF, ESRI ASCII grid, XYZ text): north-up, square cells, no holes. Its
// coordinates and heights are world ones. Between cell centres: Catmull-Rom bicubic interpolation in double; beyond
// the raster its border goes on.
struct DemTerrain {
  std::filesystem::path file;
};

// A matrix of heights added to the ground over a rectangle: `heights_m` row by row from the north-west corner, the
// outermost values on the rectangle's sides. Interpolated bicubically (Catmull-Rom); beyond the rectangle it falls to
// zero within one spacing of the matrix and stays so after two.
struct TerrainModification {
  Vec2d center, size_m;
  int columns = 0, rows = 0;
  std::vector<double> heights_m;
};

// -depth exp(-r^2/2) on a 9 x 9 matrix that spans r = -4 to 4 (the crater of Rommel 2008).
TerrainModification crater(Vec2d center, Vec2d size_m, double depth_m);

struct Terrain {
  // Rolling ground: a few sinusoids of seeded directions and phases. It is added to every shape below but those that
  // say what they do with it; alone, without relief, it is the plane z = 0.
  double relief_m = 0;       // bound on highest minus lowest ground
  double wavelength_m = 60;  // of the longest wave

  std::variant<std::monostate, PlaneTerrain, RampTerrain, StepTerrain, TerracesTerrain, SinusoidTerrain, FractalTerrain,
               QuarryTerrain, IslandTerrain, DemTerrain>
      shape{};
  std::vector<TerrainModification> modifications{};
  std::optional<double> water_level_m{};  // a level water surface wherever the ground is lower
};

// As scene files name the shape: "rolling", "plane", ..., "dem".
std::string kind_name(const Terrain& terrain);

}  // namespace skysweep::scene
