// SPDX-License-Identifier: Apache-2.0
#include "scene/file/terrain_json.h"

#include <string>

#include "raster/digest.h"

namespace skysweep::scene {
namespace {

using Json = nlohmann::ordered_json;

Json pair(Vec2d v) { return {v.x, v.y}; }

// Name and content: the folder it lay in changes nothing.
Json file_json(const std::filesystem::path& file) {
  return {{"file", file.filename().string()}, {"digest", raster::digest_of_file(file)}};
}

struct ShapeJson {
  Json operator()(const std::monostate&) const { return Json::object(); }
  Json operator()(const PlaneTerrain& s) const {
    return {{"slope_deg", s.slope_deg}, {"azimuth_deg", s.azimuth_deg}, {"center", pair(s.center)}};
  }
  Json operator()(const RampTerrain& s) const {
    return {{"slope_deg", s.slope_deg},
            {"length_m", s.length_m},
            {"break_width_m", s.break_width_m},
            {"azimuth_deg", s.azimuth_deg},
            {"center", pair(s.center)}};
  }
  Json operator()(const StepTerrain& s) const {
    return {
        {"height_m", s.height_m}, {"face_deg", s.face_deg}, {"azimuth_deg", s.azimuth_deg}, {"center", pair(s.center)}};
  }
  Json operator()(const TerracesTerrain& s) const {
    return {{"steps", s.steps},       {"height_m", s.height_m},       {"bench_m", s.bench_m},
            {"face_deg", s.face_deg}, {"azimuth_deg", s.azimuth_deg}, {"center", pair(s.center)}};
  }
  Json operator()(const SinusoidTerrain& s) const {
    return {{"azimuth_deg", s.azimuth_deg}, {"center", pair(s.center)}};
  }
  Json operator()(const FractalTerrain& s) const { return {{"octaves", s.octaves}, {"roughness", s.roughness}}; }
  Json operator()(const QuarryTerrain& s) const {
    return {{"center", pair(s.center)}, {"size_m", pair(s.size_m)},        {"heading_deg", s.heading_deg},
            {"steps", s.steps},         {"height_m", s.height_m},          {"bench_m", s.bench_m},
            {"face_deg", s.face_deg},   {"break_width_m", s.break_width_m}};
  }
  Json operator()(const IslandTerrain& s) const {
    return {{"center", pair(s.center)},     {"radius_m", s.radius_m}, {"height_m", s.height_m},
            {"sea_depth_m", s.sea_depth_m}, {"hills_m", s.hills_m},   {"koch_depth", s.koch_depth}};
  }
  Json operator()(const DemTerrain& s) const { return file_json(s.file); }
};

}  // namespace

Json terrain_json(const Terrain& terrain) {
  Json out = {{"relief_m", terrain.relief_m}, {"wavelength_m", terrain.wavelength_m}};
  if (terrain.shape.index() != 0) {
    out["kind"] = kind_name(terrain);
    out.update(std::visit(ShapeJson{}, terrain.shape));
  }
  for (const TerrainModification& change : terrain.modifications)
    out["modification"].push_back({{"center", pair(change.center)},
                                   {"size_m", pair(change.size_m)},
                                   {"columns", change.columns},
                                   {"rows", change.rows},
                                   {"heights_m", change.heights_m}});
  if (terrain.water_level_m) out["water_level_m"] = *terrain.water_level_m;
  return out;
}

Json texture_json(const Scene& scene) {
  const Texture& texture = scene.texture;
  Json out = {{"contrast", texture.contrast}, {"finest_m", scene.finest_detail_m()}};
  switch (texture.ground) {
    case GroundTexture::natural: break;
    case GroundTexture::tiles: out.update({{"kind", "tiles"}, {"period_m", texture.period_m}}); break;
    case GroundTexture::asphalt: out["kind"] = "asphalt"; break;
    case GroundTexture::none: return {{"kind", "none"}};
    case GroundTexture::checker: out.update({{"kind", "checker"}, {"period_m", texture.period_m}}); break;
    case GroundTexture::image:
      out["kind"] = "image";
      out.update(file_json(texture.image));
      break;
  }
  return out;
}

}  // namespace skysweep::scene
