// SPDX-License-Identifier: Apache-2.0
#include "scene/file/read_flight.h"

#include <optional>
#include <vector>

#include "formats/pose_set.h"
#include "scene/file/read_values.h"

namespace skysweep::scene {
namespace {

camera::CameraModel read_camera(const TomlTable& table, const std::string& file) {
  camera::CameraModel out;
  required(table.integer("width_px"), "camera.width_px", file);
  required(table.integer("height_px"), "camera.height_px", file);
  read(table, "width_px", out.width_px, 1, 100000);
  read(table, "height_px", out.height_px, 1, 100000);
  out.fx_px = required(table.number("focal_px"), "camera.focal_px", file);
  read(table, "focal_px", out.fx_px, kTiny);
  out.fy_px = out.fx_px;
  read(table, "focal_y_px", out.fy_px, kTiny);
  out.cx_px = 0.5 * out.width_px;
  out.cy_px = 0.5 * out.height_px;
  if (const auto c = read_numbers(table, "principal_point_px", 2)) out.cx_px = (*c)[0], out.cy_px = (*c)[1];
  if (const auto d = read_numbers(table, "distortion", 5))
    out.distortion = {(*d)[0], (*d)[1], (*d)[2], (*d)[3], (*d)[4]};
  return out;
}

void refuse_without_effect(const TomlTable& table, const std::vector<const char*>& keys, const std::string& on) {
  for (const char* key : keys)
    if (table.has(key)) throw usage_error(table.where(key) + " has no effect on " + on + ": remove it");
}

std::optional<std::vector<double>> read_list(const TomlTable& table, const std::string& key, double low, double high,
                                             const std::string& must) {
  std::optional<std::vector<double>> found = table.numbers(key);
  if (!found) return std::nullopt;
  bool good = !found->empty();
  for (const double value : *found) good = good && value >= low && value <= high;
  if (!good) throw usage_error(table.where(key) + " must be a list of " + must);
  return found;
}

void read_altitudes(const TomlTable& table, Flight& out) {
  if (const auto altitudes = read_list(table, "altitudes_m", kTiny, kAny, "altitudes above 0, at least one"))
    out.altitudes_m = *altitudes;
}

void read_deviations(const TomlTable& table, Flight& out) {
  read(table, "tilt_sigma_deg", out.tilt_sigma_deg, 0, 45);
  read(table, "position_sigma_m", out.position_sigma_m, 0);
  read(table, "tilt_drift_sigma_deg", out.tilt_drift_sigma_deg, 0, 45);
  read(table, "drift_sigma_m", out.drift_sigma_m, 0);
  read(table, "drift_photographs", out.drift_photographs, kTiny);
  if (out.drift_sigma_m == 0 && out.tilt_drift_sigma_deg == 0)
    refuse_without_effect(table, {"drift_photographs"}, "a flight without drift_sigma_m or tilt_drift_sigma_deg");
}

void read_strips(const TomlTable& table, Flight& out) {
  refuse_without_effect(table, {"target", "radius_m", "photographs"}, "strips (pattern = \"orbit\" has it)");
  read(table, "gsd_m", out.gsd_m, kTiny);
  read_altitudes(table, out);
  if (!out.altitudes_m.empty())
    refuse_without_effect(table, {"gsd_m"}, "a flight with altitudes_m, which gives the GSD");
  read(table, "along_overlap", out.along_overlap, 0, 0.99);
  read(table, "across_overlap", out.across_overlap, 0, 0.99);
  read(table, "heading_deg", out.heading_deg, -360, 360);
  read(table, "beyond_area_m", out.beyond_area_m);
  out.cross_strips = table.boolean("cross_strips").value_or(false);
  out.terrain_following = table.boolean("terrain_following").value_or(false);
  read(table, "off_nadir_deg", out.off_nadir_deg, 0, 89);
  if (const auto looks = read_list(table, "looks_deg", -360, 360, "directions between -360 and 360, at least one"))
    out.looks_deg = *looks;
  read_deviations(table, out);
}

void read_orbit(const TomlTable& table, const std::string& file, Vec2d area_m, Flight& out) {
  refuse_without_effect(table,
                        {"gsd_m", "along_overlap", "across_overlap", "heading_deg", "beyond_area_m", "cross_strips",
                         "terrain_following", "off_nadir_deg", "looks_deg"},
                        "an orbit");
  required(table.numbers("altitudes_m"), "altitudes_m of an orbit", file);
  read_altitudes(table, out);
  required(table.number("radius_m"), "radius_m of an orbit", file);
  read(table, "radius_m", out.radius_m, kTiny);
  read(table, "photographs", out.photographs, 1, 9999);
  out.target = {0.5 * area_m.x, 0.5 * area_m.y, 0};
  if (const auto t = read_numbers(table, "target", 3)) out.target = {(*t)[0], (*t)[1], (*t)[2]};
  for (const double altitude : out.altitudes_m)
    if (altitude <= out.target.z)
      throw usage_error(table.where("altitudes_m") + " must be above the height of the target, " +
                        std::to_string(out.target.z) + " m");
  read_deviations(table, out);
}

// The poses of a file in the scene's frame; gives back the cameras that it names.
std::vector<camera::CameraModel> read_given(const TomlTable& table, const std::filesystem::path& folder, Vec3d origin,
                                            Flight& out) {
  refuse_without_effect(
      table,
      {"pattern", "gsd_m", "altitudes_m", "along_overlap", "across_overlap", "heading_deg", "beyond_area_m",
       "cross_strips", "terrain_following", "off_nadir_deg", "looks_deg", "target", "radius_m", "photographs",
       "tilt_sigma_deg", "position_sigma_m", "tilt_drift_sigma_deg", "drift_sigma_m", "drift_photographs"},
      "a flight whose poses are given");
  const std::string path = (folder / *table.string("poses")).string();
  const formats::PoseSet set = formats::read_poses(path);
  if (!set.refused.empty()) throw usage_error(table.where("poses") + ": " + set.refused.front().reason);
  if (set.images.empty()) throw usage_error(table.where("poses") + ": there is no pose in " + path);
  std::vector<camera::CameraModel> cameras;
  for (const formats::PosedImage& image : set.images) {
    out.poses.push_back({image.pose.cam_from_world, camera::snap_position(image.pose.center - origin)});
    cameras.push_back(image.model);
  }
  return cameras;
}

}  // namespace

void read_camera_and_flights(const TomlTable& scene, const std::filesystem::path& folder, const std::string& file,
                             Scene& out) {
  std::vector<Flight> flights;
  std::vector<camera::CameraModel> cameras;
  for (const TomlTable& table : scene.one_or_more_tables("flight")) {
    Flight flight;
    if (table.has("poses")) {
      flight.pattern = FlightPattern::given;
      for (const auto& camera : read_given(table, folder, out.origin, flight)) cameras.push_back(camera);
    } else {
      const std::string pattern = table.string("pattern").value_or("strips");
      if (pattern != "strips" && pattern != "orbit")
        throw usage_error(table.where("pattern") + " must be \"strips\" or \"orbit\", not \"" + pattern +
                          "\"; poses = \"FILE\" flies given poses");
      if (pattern == "orbit") {
        flight.pattern = FlightPattern::orbit;
        read_orbit(table, file, out.area_m, flight);
      } else {
        read_strips(table, flight);
      }
    }
    flights.push_back(std::move(flight));
  }
  if (const auto table = scene.table("camera")) {
    out.camera = read_camera(*table, file);
  } else {
    const std::string missing = file + ": the table [camera] is missing";
    if (cameras.empty()) throw usage_error(missing);
    for (const camera::CameraModel& camera : cameras)
      if (camera != cameras.front())
        throw usage_error(missing + ", and the poses given have several cameras: a scene has one");
    out.camera = cameras.front();
  }
  if (flights.empty()) return;
  out.flight = std::move(flights.front());
  out.further_flights.assign(std::make_move_iterator(flights.begin() + 1), std::make_move_iterator(flights.end()));
}

}  // namespace skysweep::scene
