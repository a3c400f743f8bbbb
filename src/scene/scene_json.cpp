// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "scene/file/objects_json.h"
#include "scene/file/terrain_json.h"
#include "scene/scene_file.h"

namespace skysweep::scene {
namespace {

using Json = nlohmann::ordered_json;

Json pair(Vec2d v) { return {v.x, v.y}; }

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
  out["terrain"] = terrain_json(scene.terrain);
  if (scene.town) out["town"] = town_json(*scene.town);
  if (!scene.buildings.empty()) out["building"] = buildings_json(scene.buildings);
  add_things(scene.things, out);
  out["texture"] = texture_json(scene);
  out["light"] = {{"sun_azimuth_deg", scene.light.sun_azimuth_deg},
                  {"sun_elevation_deg", scene.light.sun_elevation_deg},
                  {"shadows", scene.light.shadows}};
  out["camera"] = camera_json(scene.camera);
  out["flight"] = flight_json(scene);
  out["photographs"] = {{"format", scene.photographs.format == PhotoFormat::png ? "png" : "jpg"},
                        {"jpeg_quality", scene.photographs.jpeg_quality},
                        {"noise_sigma", scene.photographs.noise_sigma},
                        {"gain_spread", scene.photographs.gain_spread}};
  out["truth"] = {{"cell_m", scene.truth_cell_m()}};
  return out.dump(2) + "\n";
}

}  // namespace skysweep::scene
