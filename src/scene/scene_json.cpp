// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "scene/effects/scene_effects.h"
#include "scene/scene_file.h"

namespace skysweep::scene {
namespace {

using Json = nlohmann::ordered_json;

Json pair(Vec2d v) { return {v.x, v.y}; }

Json town_json(const Town& town) {
  return {{"block_m", town.block_m},
          {"street_m", town.street_m},
          {"heading_deg", town.heading_deg},
          {"min_height_m", town.min_height_m},
          {"max_height_m", town.max_height_m},
          {"roof_units", town.roof_units},
          {"cars_per_100m", town.cars_per_100m}};
}

Json buildings_json(const std::vector<Building>& buildings) {
  Json out = Json::array();
  for (const Building& b : buildings)
    out.push_back({{"center", pair(b.center)},
                   {"size_m", pair(b.size_m)},
                   {"heading_deg", b.heading_deg},
                   {"roof_z_m", b.roof_z_m}});
  return out;
}

Json camera_json(const camera::CameraModel& c) {
  const camera::Distortion& d = c.distortion;
  return {{"width_px", c.width_px},
          {"height_px", c.height_px},
          {"focal_px", c.focal_px()},
          {"principal_point_px", {c.cx_px, c.cy_px}},
          {"distortion", {d.k1, d.k2, d.p1, d.p2, d.k3}}};
}

Json flight_json(const Scene& scene) {
  const Flight& f = scene.flight;
  return {{"gsd_m", f.gsd_m},
          {"altitude_m", scene.altitude_m()},
          {"along_overlap", f.along_overlap},
          {"across_overlap", f.across_overlap},
          {"heading_deg", f.heading_deg},
          {"beyond_area_m", f.beyond_area_m},
          {"off_nadir_deg", f.off_nadir_deg},
          {"tilt_sigma_deg", f.tilt_sigma_deg},
          {"position_sigma_m", f.position_sigma_m}};
}

}  // namespace

std::string scene_to_json(const Scene& scene) {
  const Vec3d o = scene.origin;
  Json out;
  out["seed"] = scene.seed;
  out["origin"] = {o.x, o.y, o.z};
  out["crs"] = scene.crs;
  out["area_m"] = pair(scene.area_m);
  out["extent"] = {{"min", {o.x, o.y}}, {"max", {o.x + scene.area_m.x, o.y + scene.area_m.y}}};
  out["terrain"] = {{"relief_m", scene.terrain.relief_m}, {"wavelength_m", scene.terrain.wavelength_m}};
  if (scene.town) out["town"] = town_json(*scene.town);
  if (!scene.buildings.empty()) out["building"] = buildings_json(scene.buildings);
  out["texture"] = {{"contrast", scene.texture.contrast}, {"finest_m", scene.finest_detail_m()}};
  out["light"] = {{"sun_azimuth_deg", scene.light.sun_azimuth_deg},
                  {"sun_elevation_deg", scene.light.sun_elevation_deg},
                  {"shadows", scene.light.shadows}};
  out["camera"] = camera_json(scene.camera);
  out["flight"] = flight_json(scene);
  out["photographs"] = {{"format", scene.photographs.format == PhotoFormat::png ? "png" : "jpg"},
                        {"jpeg_quality", scene.photographs.jpeg_quality},
                        {"noise_sigma", scene.photographs.noise_sigma},
                        {"gain_spread", scene.photographs.gain_spread}};
  if (const Json effects = effects_json(scene.effects); !effects.empty()) out["effects"] = effects;
  out["truth"] = {{"cell_m", scene.truth_cell_m()}};
  return out.dump(2) + "\n";
}

}  // namespace skysweep::scene
