// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "scene/effects/scene_effects.h"
#include "scene/file/flight_json.h"
#include "scene/file/objects_json.h"
#include "scene/file/products_json.h"
#include "scene/file/terrain_json.h"
#include "scene/scene_file.h"

namespace skysweep::scene {
namespace {

using Json = nlohmann::ordered_json;

Json pair(Vec2d v) { return {v.x, v.y}; }

}  // namespace

std::string scene_to_json(const Scene& scene) {
  const Vec3d o = scene.origin;
  Json out;
  out["seed"] = scene.seed;
  out["origin"] = {o.x, o.y, o.z};
  out["crs"] = scene.crs;
  out["area_m"] = pair(scene.area_m);
  out["extent"] = {{"min", {o.x, o.y}}, {"max", {o.x + scene.area_m.x, o.y + scene.area_m.y}}};
  out["terrain"] = terrain_json(scene.terrain);
  if (scene.town) out["town"] = town_json(*scene.town);
  if (!scene.buildings.empty()) out["building"] = buildings_json(scene.buildings);
  add_things(scene.things, out);
  out["texture"] = texture_json(scene);
  out["light"] = {{"sun_azimuth_deg", scene.light.sun_azimuth_deg},
                  {"sun_elevation_deg", scene.light.sun_elevation_deg},
                  {"shadows", scene.light.shadows}};
  out["camera"] = camera_json(scene.camera);
  out["flight"] = flights_json(scene);
  out["photographs"] = {{"format", file_ending(scene.photographs.format)},
                        {"jpeg_quality", scene.photographs.jpeg_quality},
                        {"noise_sigma", scene.photographs.noise_sigma},
                        {"gain_spread", scene.photographs.gain_spread}};
  if (scene.photographs.max_error_levels > 0)
    out["photographs"]["max_error_levels"] = scene.photographs.max_error_levels;
  add_products_json(scene, out);
  if (const Json effects = effects_json(scene.effects); !effects.empty()) out["effects"] = effects;
  return out.dump(2) + "\n";
}

}  // namespace skysweep::scene
