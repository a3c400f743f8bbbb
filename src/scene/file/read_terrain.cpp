// SPDX-License-Identifier: Apache-2.0
#include "scene/file/read_terrain.h"

#include <array>
#include <string>
#include <utility>

#include "scene/file/read_values.h"

namespace skysweep::scene {
namespace {

constexpr double kSteepest_deg = 85;

void read_position(const TomlTable& table, const std::string& key, Vec2d& value) {
  if (const auto found = read_numbers(table, key, 2)) value = {(*found)[0], (*found)[1]};
}

PlaneTerrain read_plane(const TomlTable& table, Vec2d middle) {
  PlaneTerrain out;
  out.center = middle;
  read(table, "slope_deg", out.slope_deg, 0, 75);
  read(table, "azimuth_deg", out.azimuth_deg, -360, 360);
  read_position(table, "center", out.center);
  return out;
}

RampTerrain read_ramp(const TomlTable& table, Vec2d middle) {
  RampTerrain out;
  out.center = middle;
  read(table, "slope_deg", out.slope_deg, 0, kSteepest_deg);
  read(table, "length_m", out.length_m, kTiny);
  read(table, "break_width_m", out.break_width_m, 0);
  read(table, "azimuth_deg", out.azimuth_deg, -360, 360);
  read_position(table, "center", out.center);
  if (out.break_width_m > out.length_m)
    throw usage_error(table.where("break_width_m") + " must not be more than length_m, the length of the slope");
  return out;
}

StepTerrain read_step(const TomlTable& table, Vec2d middle) {
  StepTerrain out;
  out.center = middle;
  read(table, "height_m", out.height_m, kTiny);
  read(table, "face_deg", out.face_deg, 1, kSteepest_deg);
  read(table, "azimuth_deg", out.azimuth_deg, -360, 360);
  read_position(table, "center", out.center);
  return out;
}

TerracesTerrain read_terraces(const TomlTable& table, Vec2d middle) {
  TerracesTerrain out;
  out.center = middle;
  read(table, "steps", out.steps, 1, 1000);
  read(table, "height_m", out.height_m, kTiny);
  read(table, "bench_m", out.bench_m, kTiny);
  read(table, "face_deg", out.face_deg, 1, kSteepest_deg);
  read(table, "azimuth_deg", out.azimuth_deg, -360, 360);
  read_position(table, "center", out.center);
  return out;
}

SinusoidTerrain read_sinusoid(const TomlTable& table, Vec2d middle) {
  SinusoidTerrain out;
  out.center = middle;
  read(table, "azimuth_deg", out.azimuth_deg, -360, 360);
  read_position(table, "center", out.center);
  return out;
}

FractalTerrain read_fractal(const TomlTable& table, Vec2d) {
  FractalTerrain out;
  read(table, "octaves", out.octaves, 1, 16);
  read(table, "roughness", out.roughness, 0, 1);
  return out;
}

QuarryTerrain read_quarry(const TomlTable& table, Vec2d middle) {
  QuarryTerrain out;
  out.center = middle;
  read_position(table, "center", out.center);
  read_size(table, "size_m", out.size_m);
  read(table, "heading_deg", out.heading_deg, -360, 360);
  read(table, "steps", out.steps, 1, 100);
  read(table, "height_m", out.height_m, kTiny);
  read(table, "bench_m", out.bench_m, kTiny);
  read(table, "face_deg", out.face_deg, 10, kSteepest_deg);
  read(table, "break_width_m", out.break_width_m, kTiny);
  const double face_m = (out.margin_m() - (out.steps - 1) * out.bench_m) / out.steps;
  if (out.break_width_m > std::min(face_m, out.bench_m))
    throw usage_error(table.where("break_width_m") + " must not be more than a bench or, in plan, a face (" +
                      std::to_string(face_m) + " m)");
  if (2 * out.corner_radius_m() > std::min(out.size_m.x, out.size_m.y))
    throw usage_error(table.where("size_m") +
                      " leaves no room for the faces and benches: both sides must be at least " +
                      std::to_string(2 * out.corner_radius_m()) + " m");
  return out;
}

IslandTerrain read_island(const TomlTable& table, Vec2d middle) {
  IslandTerrain out;
  out.center = middle;
  read_position(table, "center", out.center);
  read(table, "radius_m", out.radius_m, kTiny);
  read(table, "height_m", out.height_m, kTiny);
  read(table, "sea_depth_m", out.sea_depth_m, kTiny);
  read(table, "hills_m", out.hills_m, 0);
  read(table, "koch_depth", out.koch_depth, 0, 6);
  return out;
}

DemTerrain read_dem_shape(const TomlTable& table, Vec2d) {
  const auto file = table.string("file");
  if (!file || file->empty()) throw usage_error(table.where("file") + " must name the raster of a terrain of kind dem");
  return {*file};
}

template <auto read_shape>
decltype(Terrain::shape) any_shape(const TomlTable& table, Vec2d middle) {
  return read_shape(table, middle);
}

using ReadShape = decltype(Terrain::shape) (*)(const TomlTable&, Vec2d);
constexpr std::array<std::pair<const char*, ReadShape>, 9> kShapes = {{{"plane", any_shape<read_plane>},
                                                                       {"ramp", any_shape<read_ramp>},
                                                                       {"step", any_shape<read_step>},
                                                                       {"terraces", any_shape<read_terraces>},
                                                                       {"sinusoid", any_shape<read_sinusoid>},
                                                                       {"fractal", any_shape<read_fractal>},
                                                                       {"quarry", any_shape<read_quarry>},
                                                                       {"island", any_shape<read_island>},
                                                                       {"dem", any_shape<read_dem_shape>}}};

// The shape that `kind` names; none is the rolling ground.
decltype(Terrain::shape) read_kind(const TomlTable& table, Vec2d middle) {
  const std::string kind = table.string("kind").value_or("rolling");
  if (kind == "rolling") return {};
  std::string known = "rolling";
  for (const auto& [name, read_shape] : kShapes) {
    if (kind == name) return read_shape(table, middle);
    known += std::string(", ") + name;
  }
  throw usage_error(table.where("kind") + " must be one of " + known + ", not \"" + kind + "\"");
}

TerrainModification read_crater(const TomlTable& table, Vec2d center, Vec2d size_m) {
  double depth = 1;
  read(table, "depth_m", depth);
  return crater(center, size_m, depth);
}

TerrainModification read_matrix(const TomlTable& table, Vec2d center, Vec2d size_m) {
  TerrainModification out{center, size_m, 0, 0, {}};
  read(table, "columns", out.columns, 2, 10000);
  read(table, "rows", out.rows, 2, 10000);
  out.heights_m = table.numbers("heights_m").value_or(std::vector<double>{});
  const auto count = static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows);
  if (out.columns < 2 || out.rows < 2 || out.heights_m.size() != count)
    throw usage_error(table.where("heights_m") + " must hold columns x rows numbers, at least 2 x 2");
  return out;
}

TerrainModification read_modification(const TomlTable& table, Vec2d middle) {
  Vec2d center = middle, size_m{10, 10};
  read_position(table, "center", center);
  read_size(table, "size_m", size_m);
  const std::string kind = table.string("kind").value_or("");
  if (kind == "crater") return read_crater(table, center, size_m);
  if (kind == "matrix") return read_matrix(table, center, size_m);
  throw usage_error(table.where("kind") + " of a modification must be crater or matrix");
}

void require_relief(const TomlTable& table, const Terrain& terrain) {
  const bool needs =
      std::holds_alternative<SinusoidTerrain>(terrain.shape) || std::holds_alternative<FractalTerrain>(terrain.shape);
  if (needs && terrain.relief_m == 0)
    throw usage_error(table.where("relief_m") + " must be above 0 for a terrain of kind " + kind_name(terrain));
}

}  // namespace

Terrain read_terrain(const TomlTable& table, Vec2d area_m) {
  const Vec2d middle = 0.5 * area_m;
  Terrain out;
  read(table, "relief_m", out.relief_m, 0);
  read(table, "wavelength_m", out.wavelength_m, kTiny);
  out.shape = read_kind(table, middle);
  require_relief(table, out);
  for (const TomlTable& change : table.tables("modification"))
    out.modifications.push_back(read_modification(change, middle));
  if (std::holds_alternative<IslandTerrain>(out.shape)) out.water_level_m = 0;
  if (const auto level = table.number("water_level_m")) out.water_level_m = *level;
  return out;
}

Texture read_texture(const TomlTable& table) {
  Texture out;
  read(table, "contrast", out.contrast, 0, 10);
  read(table, "finest_m", out.finest_m, kTiny);
  constexpr std::array<std::pair<const char*, GroundTexture>, 6> kKinds = {{{"natural", GroundTexture::natural},
                                                                            {"tiles", GroundTexture::tiles},
                                                                            {"asphalt", GroundTexture::asphalt},
                                                                            {"checker", GroundTexture::checker},
                                                                            {"image", GroundTexture::image},
                                                                            {"none", GroundTexture::none}}};
  const std::string kind = table.string("kind").value_or("natural");
  bool found = false;
  for (const auto& [name, ground] : kKinds) {
    if (kind != name) continue;
    out.ground = ground;
    found = true;
  }
  if (!found)
    throw usage_error(table.where("kind") + " must be natural, tiles, asphalt, checker, image or none, not \"" + kind +
                      "\"");
  if (out.ground == GroundTexture::none && (table.has("contrast") || table.has("finest_m")))
    throw usage_error(table.where("kind") + " none has neither contrast nor finest_m: leave them out");
  if (out.ground == GroundTexture::tiles || out.ground == GroundTexture::checker)
    read(table, "period_m", out.period_m, kTiny);
  if (out.ground == GroundTexture::image) {
    out.image = table.string("file").value_or("");
    if (out.image.empty())
      throw usage_error(table.where("file") + " must name the orthophoto of a texture of kind image");
  }
  return out;
}

void resolve_files(Scene& scene, const std::filesystem::path& folder) {
  if (auto* dem = std::get_if<DemTerrain>(&scene.terrain.shape)) dem->file = folder / dem->file;
  if (!scene.texture.image.empty()) scene.texture.image = folder / scene.texture.image;
}

}  // namespace skysweep::scene
