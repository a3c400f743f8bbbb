// SPDX-License-Identifier: Apache-2.0
#include "scene/file/flight_json.h"

namespace skysweep::scene {
namespace {

using Json = nlohmann::ordered_json;

Json poses_json(const std::vector<camera::Pose>& poses) {
  Json out = Json::array();
  for (const camera::Pose& pose : poses) {
    const camera::Quaternion q = camera::quaternion_from_rotation(pose.cam_from_world);
    out.push_back({pose.center.x, pose.center.y, pose.center.z, q.w, q.x, q.y, q.z});
  }
  return out;
}

// What a flight may leave out stands in the file only where it has an effect.
void add_drift(const Flight& f, Json& out) {
  if (f.drift_sigma_m == 0 && f.tilt_drift_sigma_deg == 0) return;
  out["drift_sigma_m"] = f.drift_sigma_m;
  out["tilt_drift_sigma_deg"] = f.tilt_drift_sigma_deg;
  out["drift_photographs"] = f.drift_photographs;
}

Json strips_json(const Flight& f, double focal_px) {
  Json out = {{"gsd_m", f.resolved_gsd_m(focal_px)},   {"altitude_m", f.resolved_altitudes_m(focal_px).front()},
              {"along_overlap", f.along_overlap},      {"across_overlap", f.across_overlap},
              {"heading_deg", f.heading_deg},          {"beyond_area_m", f.beyond_area_m},
              {"off_nadir_deg", f.off_nadir_deg},      {"tilt_sigma_deg", f.tilt_sigma_deg},
              {"position_sigma_m", f.position_sigma_m}};
  if (f.altitudes_m.size() > 1) out["altitudes_m"] = f.altitudes_m;
  if (f.cross_strips) out["cross_strips"] = true;
  if (f.terrain_following) out["terrain_following"] = true;
  if (f.looks_deg != Flight{}.looks_deg) out["looks_deg"] = f.looks_deg;
  add_drift(f, out);
  return out;
}

Json orbit_json(const Flight& f, double focal_px) {
  Json out = {{"pattern", "orbit"},
              {"gsd_m", f.resolved_gsd_m(focal_px)},
              {"altitudes_m", f.altitudes_m},
              {"target", {f.target.x, f.target.y, f.target.z}},
              {"radius_m", f.radius_m},
              {"photographs", f.photographs},
              {"tilt_sigma_deg", f.tilt_sigma_deg},
              {"position_sigma_m", f.position_sigma_m}};
  add_drift(f, out);
  return out;
}

Json flight_json(const Flight& f, double focal_px) {
  switch (f.pattern) {
    case FlightPattern::orbit: return orbit_json(f, focal_px);
    case FlightPattern::given: return {{"gsd_m", f.resolved_gsd_m(focal_px)}, {"poses", poses_json(f.poses)}};
    default: return strips_json(f, focal_px);
  }
}

}  // namespace

Json camera_json(const camera::CameraModel& c) {
  const camera::Distortion& d = c.distortion;
  Json out = {{"width_px", c.width_px}, {"height_px", c.height_px}, {"focal_px", c.fx_px}};
  if (c.fy_px != c.fx_px) out["focal_y_px"] = c.fy_px;
  out["principal_point_px"] = {c.cx_px, c.cy_px};
  out["distortion"] = {d.k1, d.k2, d.p1, d.p2, d.k3};
  return out;
}

Json flights_json(const Scene& scene) {
  const double focal_px = scene.camera.focal_px();
  if (scene.further_flights.empty()) return flight_json(scene.flight, focal_px);
  Json out = Json::array();
  for (const Flight* flight : scene.flights()) out.push_back(flight_json(*flight, focal_px));
  return out;
}

}  // namespace skysweep::scene
