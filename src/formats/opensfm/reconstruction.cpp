// SPDX-License-Identifier: Apache-2.0
// OpenSfM's conventions ("Geometric Models" in its documentation): lengths in the image are normalised by the longer
// side, with the origin in the middle of the image and y downwards; the camera frame is ours; a shot's rotation
// (angle-axis) and translation lead from the world to the camera. The middle of the image is (width / 2, height / 2)
// where the centre of the top-left pixel is (0.5, 0.5).
#include "formats/opensfm/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "formats/collect/pose_collector.h"

namespace skysweep::formats {
namespace {

using Json = nlohmann::json;

struct ParsedFile {
  Json reconstructions;  // a list of at least one object, each with an object "shots"
  // Index of the reconstruction and name of every shot that stands in it more than once: JSON keeps the last silently.
  std::set<std::pair<int, std::string>> repeated_shots;
};

// Leaves out the points, which are nearly all of such a file and no part of the poses.
ParsedFile parse(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw bad_input(path + ": cannot be opened.");
  ParsedFile file;
  int index = -1;
  std::string section;
  std::set<std::string> shots;
  const auto keep = [&](int depth, Json::parse_event_t event, const Json& value) {
    if (depth == 1 && event == Json::parse_event_t::object_start) ++index;
    if (event != Json::parse_event_t::key) return true;
    if (depth == 2) {
      section = value.get<std::string>();
      shots.clear();
      return section != "points";
    }
    if (depth == 3 && section == "shots" && !shots.insert(value.get<std::string>()).second)
      file.repeated_shots.emplace(index, value.get<std::string>());
    return true;
  };
  try {
    file.reconstructions = Json::parse(stream, keep);
  } catch (const Json::exception& error) {
    throw bad_input(path + ": is not valid JSON: " + error.what());
  }
  const auto has_shots = [](const Json& r) { return r.is_object() && r.contains("shots") && r["shots"].is_object(); };
  const Json& list = file.reconstructions;
  if (!list.is_array() || list.empty() || !std::all_of(list.begin(), list.end(), has_shots))
    throw bad_input(path +
                    ": is no OpenSfM reconstruction: a list of objects with \"cameras\" and \"shots\" is expected.");
  return file;
}

// "path: shot 'a.jpg'", "path: camera 'c'"
std::string place(const std::string& path, const char* what, const std::string& name) {
  return path + ": " + what + " '" + name + "'";
}

double number(const Json& object, const char* key, const std::string& where) {
  if (!object.contains(key)) throw bad_input(where + ": has no '" + key + "'.");
  const Json& value = object.at(key);
  if (!value.is_number()) throw bad_input(where + ": '" + key + "' is not a number.");
  return value.get<double>();
}

double number_or_zero(const Json& object, const char* key, const std::string& where) {
  return object.contains(key) ? number(object, key, where) : 0;
}

Vec3d vector(const Json& object, const char* key, const std::string& where) {
  const Json value = object.value(key, Json());
  const bool usable = value.is_array() && value.size() == 3 &&
                      std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number(); });
  if (!usable) throw bad_input(where + ": '" + key + "' is not a list of three numbers.");
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

int size(const Json& object, const char* key, const std::string& where) {
  const double value = number(object, key, where);
  if (!(value >= 1 && value <= 1e6)) throw bad_input(where + ": '" + key + "' is no image size.");
  return static_cast<int>(value);
}

camera::CameraModel read_camera(const Json& camera, const std::string& where) {
  if (!camera.is_object()) throw bad_input(where + ": is not an object with the camera's values.");
  const std::string projection = camera.value("projection_type", Json("perspective")).dump();
  const bool one_focal_length = projection == "\"perspective\"";
  if (!one_focal_length && projection != "\"brown\"" && projection != "\"radial\"" && projection != "\"simple_radial\"")
    throw bad_input(where + ": the projection type " + projection +
                    " is not supported; supported are perspective, brown, radial and simple_radial.");

  camera::CameraModel model;
  model.width_px = size(camera, "width", where);
  model.height_px = size(camera, "height", where);
  const double longer_side_px = std::max(model.width_px, model.height_px);
  model.fx_px = longer_side_px * number(camera, one_focal_length ? "focal" : "focal_x", where);
  model.fy_px = longer_side_px * number(camera, one_focal_length ? "focal" : "focal_y", where);
  model.cx_px = 0.5 * model.width_px + longer_side_px * number_or_zero(camera, "c_x", where);
  model.cy_px = 0.5 * model.height_px + longer_side_px * number_or_zero(camera, "c_y", where);
  model.distortion = {number_or_zero(camera, "k1", where), number_or_zero(camera, "k2", where),
                      number_or_zero(camera, "p1", where), number_or_zero(camera, "p2", where),
                      number_or_zero(camera, "k3", where)};
  if (const auto problem = model.problem()) throw bad_input(where + ": the camera cannot be used: " + *problem + ".");
  return model;
}

// Rotation by |v| about v (Rodrigues 1840).
Mat3d rotation_from_angle_axis(Vec3d v, const std::string& where) {
  const double angle = norm(v);
  if (!std::isfinite(angle)) throw bad_input(where + ": the rotation is no number of radians.");
  const double half_sine_per_angle = angle < 1e-12 ? 0.5 : std::sin(0.5 * angle) / angle;
  const Vec3d q = half_sine_per_angle * v;
  const auto rotation = camera::rotation_from_quaternion(std::cos(0.5 * angle), q.x, q.y, q.z);
  SKY_CHECK(rotation.has_value());  // sine and cosine make a unit quaternion
  return *rotation;
}

camera::Pose read_pose(const Json& shot, const std::string& where) {
  const Mat3d rotation = rotation_from_angle_axis(vector(shot, "rotation", where), where);
  return {rotation, -(transpose(rotation) * vector(shot, "translation", where))};
}

PosedImage read_shot(const std::string& path, const std::string& name, const Json& shot, const Json& cameras) {
  const std::string where = place(path, "shot", name);
  if (!shot.is_object() || !shot.contains("camera") || !shot["camera"].is_string())
    throw bad_input(where + ": names no camera.");
  const std::string camera = shot["camera"].get<std::string>();
  if (!cameras.contains(camera)) throw bad_input(where + ": its camera '" + camera + "' is not in the file.");
  return {name, read_camera(cameras[camera], place(path, "camera", camera)), read_pose(shot, where), where};
}

// The reconstructions of a file do not share a frame, so only one of them can be mapped from.
int index_of_largest(const Json& reconstructions) {
  const auto largest =
      std::max_element(reconstructions.begin(), reconstructions.end(),
                       [](const Json& a, const Json& b) { return a["shots"].size() < b["shots"].size(); });
  return static_cast<int>(largest - reconstructions.begin());
}

void note_others(const Json& reconstructions, int chosen, const std::string& path, PoseCollector& collector) {
  if (reconstructions.size() == 1) return;
  const std::size_t read = reconstructions[chosen]["shots"].size();
  std::size_t all = 0;
  for (const Json& reconstruction : reconstructions) all += reconstruction["shots"].size();
  collector.note(path + ": holds " + std::to_string(reconstructions.size()) +
                 " reconstructions, each in a frame of its own; the largest, of " + std::to_string(read) +
                 " shots, was read and " + std::to_string(all - read) + " shots of the others were left out.");
}

void note_reference(const Json& reconstruction, const std::string& path, PoseCollector& collector) {
  const std::filesystem::path beside = std::filesystem::path(path).parent_path() / "reference_lla.json";
  const bool inside = reconstruction.contains("reference_lla");
  if (!inside && !std::filesystem::exists(beside)) return;
  collector.note((inside ? path + ": the reference point " + reconstruction["reference_lla"].dump()
                         : beside.string() + ": the reference point") +
                 " was not applied: positions stay metres east, north and up of it; give its map coordinates as the "
                 "origin.");
}

}  // namespace

PoseSet read_opensfm(const std::string& path) {
  const ParsedFile file = parse(path);
  const int chosen = index_of_largest(file.reconstructions);
  const Json& reconstruction = file.reconstructions[chosen];
  PoseCollector collector(path);
  note_others(file.reconstructions, chosen, path, collector);
  note_reference(reconstruction, path, collector);
  const Json cameras = reconstruction.value("cameras", Json::object());
  for (const auto& [name, shot] : reconstruction["shots"].items()) {
    const std::string where = place(path, "shot", name);
    try {
      if (file.repeated_shots.contains({chosen, name}))
        throw bad_input(where + ": stands in the file more than once; keep one of them.");
      collector.add(read_shot(path, name, shot, cameras));
    } catch (const Error& error) {
      collector.refuse(name, where, error.what());
    }
  }
  return std::move(collector).finish();
}

}  // namespace skysweep::formats
