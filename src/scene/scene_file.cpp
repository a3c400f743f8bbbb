// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_file.h"

#include <limits>
#include <optional>
#include <sstream>

#include "camera/pose.h"
#include "core/error.h"
#include "scene/effects/scene_effects.h"
#include "settings/toml_table.h"

namespace skysweep::scene {
namespace {

using settings::TomlTable;

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-6;  // lower limit of what has to be above zero

// Replaces `value` by that of the key, if it is there; refuses it outside [low, high].
void read(const TomlTable& table, const std::string& key, double& value, double low = -kAny, double high = kAny) {
  const std::optional<double> found = table.number(key);
  if (!found) return;
  if (*found < low || *found > high) {
    std::ostringstream range;
    if (low == kTiny && high == kAny)
      range << "must be above 0";
    else if (high == kAny)
      range << "must be at least " << low;
    else
      range << "must lie between " << low << " and " << high;
    throw usage_error(table.where(key) + " " + range.str());
  }
  value = *found;
}

void read(const TomlTable& table, const std::string& key, int& value, int low, int high) {
  const std::optional<long long> found = table.integer(key);
  if (!found) return;
  if (*found < low || *found > high)
    throw usage_error(table.where(key) + " must lie between " + std::to_string(low) + " and " + std::to_string(high));
  value = static_cast<int>(*found);
}

// Exactly `count` numbers, or nothing if the key is absent.
std::optional<std::vector<double>> read_numbers(const TomlTable& table, const std::string& key, std::size_t count) {
  std::optional<std::vector<double>> found = table.numbers(key);
  if (found && found->size() != count)
    throw usage_error(table.where(key) + " must be a list of " + std::to_string(count) + " numbers");
  return found;
}

void read_size(const TomlTable& table, const std::string& key, Vec2d& value) {
  const auto found = read_numbers(table, key, 2);
  if (!found) return;
  value = {(*found)[0], (*found)[1]};
  if (!(value.x > 0 && value.y > 0)) throw usage_error(table.where(key) + " must be two numbers above 0");
}

template <typename T>
T required(std::optional<T> value, const std::string& what, const std::string& file) {
  if (!value) throw usage_error(file + ": " + what + " is missing");
  return *value;
}

Terrain read_terrain(const TomlTable& table) {
  Terrain out;
  read(table, "relief_m", out.relief_m, 0);
  read(table, "wavelength_m", out.wavelength_m, kTiny);
  return out;
}

Town read_town(const TomlTable& table) {
  Town out;
  read(table, "block_m", out.block_m, 8);
  read(table, "street_m", out.street_m, 1);
  read(table, "heading_deg", out.heading_deg, -360, 360);
  read(table, "min_height_m", out.min_height_m, kTiny);
  read(table, "max_height_m", out.max_height_m, kTiny);
  if (out.max_height_m < out.min_height_m)
    throw usage_error(table.where("max_height_m") + " must not be below min_height_m");
  read(table, "roof_units", out.roof_units, 0, 100);
  read(table, "cars_per_100m", out.cars_per_100m, 0, 100. / 6);
  return out;
}

Building read_building(const TomlTable& table, const std::string& file) {
  Building out;
  const auto center = required(read_numbers(table, "center", 2), "center = [x, y] of a building", file);
  out.center = {center[0], center[1]};
  required(table.numbers("size_m"), "size_m = [x, y] of a building", file);
  read_size(table, "size_m", out.size_m);
  read(table, "heading_deg", out.heading_deg, -360, 360);
  out.roof_z_m = required(table.number("roof_z_m"), "roof_z_m of a building", file);
  return out;
}

Texture read_texture(const TomlTable& table) {
  Texture out;
  read(table, "contrast", out.contrast, 0, 10);
  read(table, "finest_m", out.finest_m, kTiny);
  return out;
}

Light read_light(const TomlTable& table) {
  Light out;
  read(table, "sun_azimuth_deg", out.sun_azimuth_deg, -360, 360);
  read(table, "sun_elevation_deg", out.sun_elevation_deg, 5, 90);
  out.shadows = table.boolean("shadows").value_or(out.shadows);
  return out;
}

camera::CameraModel read_camera(const TomlTable& table, const std::string& file) {
  camera::CameraModel out;
  required(table.integer("width_px"), "camera.width_px", file);
  required(table.integer("height_px"), "camera.height_px", file);
  read(table, "width_px", out.width_px, 1, 100000);
  read(table, "height_px", out.height_px, 1, 100000);
  out.fx_px = required(table.number("focal_px"), "camera.focal_px", file);
  read(table, "focal_px", out.fx_px, kTiny);
  out.fy_px = out.fx_px;
  out.cx_px = 0.5 * out.width_px;
  out.cy_px = 0.5 * out.height_px;
  if (const auto c = read_numbers(table, "principal_point_px", 2)) out.cx_px = (*c)[0], out.cy_px = (*c)[1];
  if (const auto d = read_numbers(table, "distortion", 5))
    out.distortion = {(*d)[0], (*d)[1], (*d)[2], (*d)[3], (*d)[4]};
  return out;
}

Flight read_flight(const TomlTable& table) {
  Flight out;
  read(table, "gsd_m", out.gsd_m, kTiny);
  read(table, "along_overlap", out.along_overlap, 0, 0.99);
  read(table, "across_overlap", out.across_overlap, 0, 0.99);
  read(table, "heading_deg", out.heading_deg, -360, 360);
  read(table, "beyond_area_m", out.beyond_area_m);
  read(table, "off_nadir_deg", out.off_nadir_deg, 0, 89);
  read(table, "tilt_sigma_deg", out.tilt_sigma_deg, 0, 45);
  read(table, "position_sigma_m", out.position_sigma_m, 0);
  return out;
}

Photographs read_photographs(const TomlTable& table) {
  Photographs out;
  if (const auto format = table.string("format")) {
    if (*format != "jpg" && *format != "png")
      throw usage_error(table.where("format") + " must be \"jpg\" or \"png\", not \"" + *format + "\"");
    out.format = *format == "png" ? PhotoFormat::png : PhotoFormat::jpeg;
  }
  read(table, "jpeg_quality", out.jpeg_quality, 1, 100);
  if (out.format == PhotoFormat::png && table.has("jpeg_quality"))
    throw usage_error(table.where("jpeg_quality") + " has no effect on PNG files: remove it");
  read(table, "noise_sigma", out.noise_sigma, 0, 255);
  read(table, "gain_spread", out.gain_spread, 0, 3);
  return out;
}

Scene scene_from(const TomlTable& file, const std::string& name) {
  Scene out;
  if (const auto seed = file.integer("seed")) out.seed = static_cast<std::uint64_t>(*seed);
  if (const auto o = read_numbers(file, "origin", 3)) out.origin = camera::snap_position({(*o)[0], (*o)[1], (*o)[2]});
  out.crs = file.string("crs").value_or("");
  read_size(file, "area_m", out.area_m);
  if (const auto table = file.table("terrain")) out.terrain = read_terrain(*table);
  if (const auto table = file.table("town")) out.town = read_town(*table);
  for (const TomlTable& table : file.tables("building")) out.buildings.push_back(read_building(table, name));
  if (const auto table = file.table("texture")) out.texture = read_texture(*table);
  if (const auto table = file.table("light")) out.light = read_light(*table);
  out.camera = read_camera(required(file.table("camera"), "the table [camera]", name), name);
  if (const auto table = file.table("flight")) out.flight = read_flight(*table);
  if (const auto table = file.table("photographs")) out.photographs = read_photographs(*table);
  if (const auto table = file.table("effects")) out.effects = read_effects(*table);
  if (const auto table = file.table("truth")) read(*table, "cell_m", out.truth.cell_m, kTiny);
  file.refuse_unknown();
  return out;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  return scene_from(TomlTable::read_file(path), path.filename().string());
}

Scene parse_scene(const std::string& text, const std::string& name) {
  return scene_from(TomlTable::parse(text, name), name);
}

}  // namespace skysweep::scene
