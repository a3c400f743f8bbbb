// SPDX-License-Identifier: Apache-2.0
#include "scene/file/objects_json.h"

namespace skysweep::scene {
namespace {

using Json = nlohmann::ordered_json;

Json pair(Vec2d v) { return {v.x, v.y}; }

const char* name(RoofKind roof) {
  switch (roof) {
    case RoofKind::gable: return "gable";
    case RoofKind::hip: return "hip";
    case RoofKind::shed: return "shed";
    case RoofKind::saw_tooth: return "saw_tooth";
    default: return "flat";
  }
}

const char* name(CrownShape shape) {
  switch (shape) {
    case CrownShape::cone: return "cone";
    case CrownShape::column: return "column";
    default: return "ellipsoid";
  }
}

Json forest_json(const Forest& f) {
  Json shapes = Json::array();
  for (const CrownShape shape : f.shapes) shapes.push_back(name(shape));
  Json out = {{"trees_per_ha", f.trees_per_ha},
              {"min_height_m", f.min_height_m},
              {"max_height_m", f.max_height_m},
              {"shapes", shapes}};
  if (f.area) out["area"] = {f.area->min.x, f.area->min.y, f.area->max.x, f.area->max.y};
  return out;
}

Json json_of(const PowerLine& line) {
  Json pylons = Json::array();
  for (const Vec2d p : line.pylons) {
    pylons.push_back(p.x);
    pylons.push_back(p.y);
  }
  return {{"pylons", pylons},
          {"height_m", line.height_m},
          {"sag_m", line.sag_m},
          {"wires", line.wires},
          {"wire_spacing_m", line.wire_spacing_m},
          {"wire_diameter_m", line.wire_diameter_m},
          {"pylon_width_m", line.pylon_width_m}};
}

Json json_of(const Tree& t) {
  return {{"position", pair(t.position)}, {"height_m", t.height_m}, {"crown_m", t.crown_m}, {"shape", name(t.shape)}};
}
Json json_of(const FreeWall& w) {
  return {{"from", pair(w.from)}, {"to", pair(w.to)}, {"height_m", w.height_m}, {"thickness_m", w.thickness_m}};
}
Json json_of(const Bridge& b) {
  return {{"from", pair(b.from)},         {"to", pair(b.to)},  {"width_m", b.width_m}, {"deck_z_m", b.deck_z_m},
          {"thickness_m", b.thickness_m}, {"ramp_m", b.ramp_m}};
}
Json json_of(const Mast& m) {
  return {{"position", pair(m.position)}, {"height_m", m.height_m}, {"width_m", m.width_m}};
}

template <typename T>
void add_all(const std::vector<T>& things, const char* key, Json& scene) {
  for (const T& thing : things) scene[key].push_back(json_of(thing));
}

}  // namespace

Json town_json(const Town& town) {
  Json out = {{"block_m", town.block_m},
              {"street_m", town.street_m},
              {"heading_deg", town.heading_deg},
              {"min_height_m", town.min_height_m},
              {"max_height_m", town.max_height_m},
              {"roof_units", town.roof_units},
              {"cars_per_100m", town.cars_per_100m}};
  const auto add_if_on = [&out](const char* key, double value) {
    if (value > 0) out[key] = value;
  };
  add_if_on("block_depth_m", town.block_depth_m);
  add_if_on("alley_m", town.alley_m);
  add_if_on("gable_share", town.gable_share);
  add_if_on("hip_share", town.hip_share);
  add_if_on("shed_share", town.shed_share);
  if (town.gable_share + town.hip_share + town.shed_share > 0) out["pitched_up_to_m"] = town.pitched_up_to_m;
  add_if_on("courtyard_share", town.courtyard_share);
  add_if_on("trees_per_block", town.trees_per_block);
  return out;
}

Json buildings_json(const std::vector<Building>& buildings) {
  Json out = Json::array();
  for (const Building& b : buildings) {
    out.push_back({{"center", pair(b.center)},
                   {"size_m", pair(b.size_m)},
                   {"heading_deg", b.heading_deg},
                   {"roof_z_m", b.roof_z_m}});
    if (b.roof != RoofKind::flat) {
      out.back()["roof"] = name(b.roof);
      out.back()["eaves_z_m"] = b.eaves_z_m;
    }
    if (b.roof == RoofKind::saw_tooth) {
      out.back()["teeth"] = b.teeth;
      out.back()["steep_deg"] = b.steep_deg;
    }
    if (b.courtyard_m) out.back()["courtyard_m"] = pair(*b.courtyard_m);
  }
  return out;
}

void add_things(const Things& things, Json& scene) {
  add_all(things.trees, "tree", scene);
  if (things.forest) scene["forest"] = forest_json(*things.forest);
  add_all(things.walls, "wall", scene);
  add_all(things.bridges, "bridge", scene);
  add_all(things.masts, "mast", scene);
  add_all(things.power_lines, "power_line", scene);
}

}  // namespace skysweep::scene
