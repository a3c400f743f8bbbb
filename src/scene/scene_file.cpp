// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_file.h"

#include <optional>

#include "camera/pose.h"
#include "core/error.h"
#include "scene/effects/scene_effects.h"
#include "scene/file/read_flight.h"
#include "scene/file/read_objects.h"
#include "scene/file/read_products.h"
#include "scene/file/read_terrain.h"
#include "scene/file/read_values.h"
#include "settings/toml_table.h"

namespace skysweep::scene {
namespace {

Light read_light(const TomlTable& table) {
  Light out;
  read(table, "sun_azimuth_deg", out.sun_azimuth_deg, -360, 360);
  read(table, "sun_elevation_deg", out.sun_elevation_deg, 5, 90);
  out.shadows = table.boolean("shadows").value_or(out.shadows);
  return out;
}

Photographs read_photographs(const TomlTable& table) {
  Photographs out;
  if (const auto format = table.string("format")) {
    out.format = read_photo_format(table, *format);
  }
  read(table, "jpeg_quality", out.jpeg_quality, 1, 100);
  if (out.format != PhotoFormat::jpeg && table.has("jpeg_quality"))
    throw usage_error(table.where("jpeg_quality") + " has no effect on files other than JPEG: remove it");
  read(table, "noise_sigma", out.noise_sigma, 0, 255);
  if (out.format == PhotoFormat::exr && table.has("noise_sigma"))
    throw usage_error(table.where("noise_sigma") +
                      " has no effect on EXR files, which hold light and no grey levels: remove it");
  read(table, "gain_spread", out.gain_spread, 0, 3);
  read(table, "max_error_levels", out.max_error_levels, 0, 100);
  return out;
}

// `folder`: what paths in the file are relative to.
Scene scene_from(const TomlTable& file, const std::filesystem::path& folder, const std::string& name) {
  Scene out;
  if (const auto seed = file.integer("seed")) out.seed = static_cast<std::uint64_t>(*seed);
  if (const auto o = read_numbers(file, "origin", 3)) out.origin = camera::snap_position({(*o)[0], (*o)[1], (*o)[2]});
  out.crs = file.string("crs").value_or("");
  read_size(file, "area_m", out.area_m);
  if (const auto table = file.table("terrain")) out.terrain = read_terrain(*table, out.area_m);
  if (const auto table = file.table("town")) out.town = read_town(*table);
  for (const TomlTable& table : file.tables("building")) out.buildings.push_back(read_building(table, name));
  out.things = read_things(file, name);
  if (const auto table = file.table("texture")) out.texture = read_texture(*table);
  if (const auto table = file.table("light")) out.light = read_light(*table);
  read_camera_and_flights(file, folder, name, out);
  if (const auto table = file.table("photographs")) out.photographs = read_photographs(*table);
  read_products(file, out);
  if (const auto table = file.table("effects")) out.effects = read_effects(*table);
  file.refuse_unknown();
  return out;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  Scene scene = scene_from(TomlTable::read_file(path), path.parent_path(), path.filename().string());
  resolve_files(scene, path.parent_path());
  return scene;
}

Scene parse_scene(const std::string& text, const std::string& name) {
  return scene_from(TomlTable::parse(text, name), {}, name);
}

}  // namespace skysweep::scene
