// SPDX-License-Identifier: Apache-2.0
#include "scene/file/read_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/file/read_values.h"

namespace skysweep::scene {
namespace {

template <typename T, std::size_t N>
using Names = std::array<std::pair<const char*, T>, N>;

constexpr Names<RoofKind, 5> kRoofs = {{{"flat", RoofKind::flat},
                                        {"gable", RoofKind::gable},
                                        {"hip", RoofKind::hip},
                                        {"shed", RoofKind::shed},
                                        {"saw_tooth", RoofKind::saw_tooth}}};
constexpr Names<CrownShape, 3> kCrowns = {
    {{"ellipsoid", CrownShape::ellipsoid}, {"cone", CrownShape::cone}, {"column", CrownShape::column}}};

template <typename T, std::size_t N>
T named(const TomlTable& table, const std::string& key, const std::string& name, const Names<T, N>& names) {
  std::string known;
  for (const auto& [word, value] : names) {
    if (name == word) return value;
    known += (known.empty() ? "\"" : ", \"") + std::string(word) + '"';
  }
  throw usage_error(table.where(key) + " must be one of " + known + ", not \"" + name + "\"");
}

Vec2d required_place(const TomlTable& table, const std::string& key, const std::string& of, const std::string& file) {
  const auto found = required(read_numbers(table, key, 2), key + " = [x, y] of a " + of, file);
  return {found[0], found[1]};
}

// The two ends of something long.
void read_ends(const TomlTable& table, const std::string& of, const std::string& file, Vec2d& from, Vec2d& to) {
  from = required_place(table, "from", of, file);
  to = required_place(table, "to", of, file);
  if (!(norm(to - from) > kTiny)) throw usage_error(table.where("to") + " must lie elsewhere than from");
}

Tree read_tree(const TomlTable& table, const std::string& file) {
  Tree out;
  out.position = required_place(table, "position", "tree", file);
  read(table, "height_m", out.height_m, kTiny);
  read(table, "crown_m", out.crown_m, kTiny);
  if (const auto shape = table.string("shape")) out.shape = named(table, "shape", *shape, kCrowns);
  return out;
}

Forest read_forest(const TomlTable& table) {
  Forest out;
  read(table, "trees_per_ha", out.trees_per_ha, kTiny, 10000);
  read(table, "min_height_m", out.min_height_m, kTiny);
  read(table, "max_height_m", out.max_height_m, kTiny);
  if (out.max_height_m < out.min_height_m)
    throw usage_error(table.where("max_height_m") + " must not be below min_height_m");
  if (const auto shapes = table.strings("shapes")) {
    if (shapes->empty()) throw usage_error(table.where("shapes") + " must name at least one crown shape");
    out.shapes.clear();
    for (const std::string& shape : *shapes) out.shapes.push_back(named(table, "shapes", shape, kCrowns));
  }
  if (const auto a = read_numbers(table, "area", 4)) {
    out.area = Box2d{{(*a)[0], (*a)[1]}, {(*a)[2], (*a)[3]}};
    if (out.area->empty()) throw usage_error(table.where("area") + " must be [x0, y0, x1, y1] with x0 <= x1, y0 <= y1");
  }
  return out;
}

FreeWall read_wall(const TomlTable& table, const std::string& file) {
  FreeWall out;
  read_ends(table, "wall", file, out.from, out.to);
  read(table, "height_m", out.height_m, kTiny);
  read(table, "thickness_m", out.thickness_m, kTiny);
  return out;
}

Bridge read_bridge(const TomlTable& table, const std::string& file) {
  Bridge out;
  read_ends(table, "bridge", file, out.from, out.to);
  read(table, "width_m", out.width_m, kTiny);
  out.deck_z_m = required(table.number("deck_z_m"), "deck_z_m of a bridge", file);
  read(table, "thickness_m", out.thickness_m, kTiny);
  read(table, "ramp_m", out.ramp_m, 0);
  return out;
}

Mast read_mast(const TomlTable& table, const std::string& file) {
  Mast out;
  out.position = required_place(table, "position", "mast", file);
  read(table, "height_m", out.height_m, kTiny);
  read(table, "width_m", out.width_m, kTiny);
  return out;
}

PowerLine read_power_line(const TomlTable& table, const std::string& file) {
  PowerLine out;
  const auto pylons = required(table.numbers("pylons"), "pylons = [x, y, x, y, ...] of a power line", file);
  if (pylons.size() < 4 || pylons.size() % 2 != 0)
    throw usage_error(table.where("pylons") + " must be [x, y, x, y, ...] with at least two pylons");
  for (std::size_t i = 0; i < pylons.size(); i += 2) {
    out.pylons.push_back({pylons[i], pylons[i + 1]});
    if (i > 0 && !(norm(out.pylons[i / 2] - out.pylons[i / 2 - 1]) > kTiny))
      throw usage_error(table.where("pylons") + " must not name one place twice in a row");
  }
  read(table, "height_m", out.height_m, kTiny);
  read(table, "sag_m", out.sag_m, 0);
  read(table, "wires", out.wires, 1, 24);
  read(table, "wire_spacing_m", out.wire_spacing_m, kTiny);
  read(table, "wire_diameter_m", out.wire_diameter_m, kTiny);
  read(table, "pylon_width_m", out.pylon_width_m, kTiny);
  return out;
}

}  // namespace

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
  read(table, "block_depth_m", out.block_depth_m, 8);
  read(table, "alley_m", out.alley_m, kTiny, 0.2 * out.block_m);
  read(table, "gable_share", out.gable_share, 0, 1);
  read(table, "hip_share", out.hip_share, 0, 1);
  read(table, "shed_share", out.shed_share, 0, 1);
  const double pitched = out.gable_share + out.hip_share + out.shed_share;
  if (pitched > 1 + 1e-9)
    throw usage_error(table.where("gable_share") + ", hip_share and shed_share must not add up to more than 1");
  read(table, "pitched_up_to_m", out.pitched_up_to_m, kTiny);
  if (!(pitched > 0) && table.has("pitched_up_to_m"))
    throw usage_error(table.where("pitched_up_to_m") + " has no effect without gable_share, hip_share or shed_share");
  read(table, "courtyard_share", out.courtyard_share, 0, 1);
  read(table, "trees_per_block", out.trees_per_block, 0, 1000);
  return out;
}

namespace {

void read_teeth(const TomlTable& table, const std::string& file, Building& out) {
  for (const char* key : {"teeth", "steep_deg"})
    if (out.roof != RoofKind::saw_tooth && table.has(key))
      throw usage_error(table.where(key) + " has no effect without roof = \"saw_tooth\": remove it");
  if (out.roof != RoofKind::saw_tooth) return;
  required(table.number("teeth"), "teeth (how many) of a building with a saw-tooth roof", file);
  read(table, "teeth", out.teeth, 1, 1000);
  read(table, "steep_deg", out.steep_deg, 30, 90);
  const double width = out.size_m.y / out.teeth, height = out.roof_z_m - out.eaves_z_m;
  if (out.steep_deg < 90 && height / std::tan(out.steep_deg * std::numbers::pi / 180) > 0.9 * width)
    throw usage_error(table.where("steep_deg") + " leaves less than a tenth of each tooth for its flat face: raise it");
}

}  // namespace

Building read_building(const TomlTable& table, const std::string& file) {
  Building out;
  out.center = required_place(table, "center", "building", file);
  required(table.numbers("size_m"), "size_m = [x, y] of a building", file);
  read_size(table, "size_m", out.size_m);
  read(table, "heading_deg", out.heading_deg, -360, 360);
  out.roof_z_m = required(table.number("roof_z_m"), "roof_z_m of a building", file);
  if (const auto roof = table.string("roof")) out.roof = named(table, "roof", *roof, kRoofs);
  if (out.roof != RoofKind::flat) {
    out.eaves_z_m = required(table.number("eaves_z_m"), "eaves_z_m of a building whose roof is not flat", file);
    if (!(out.eaves_z_m < out.roof_z_m)) throw usage_error(table.where("eaves_z_m") + " must lie below roof_z_m");
  } else if (table.has("eaves_z_m")) {
    throw usage_error(table.where("eaves_z_m") + " has no effect on a flat roof: remove it");
  }
  read_teeth(table, file, out);
  if (table.has("courtyard_m")) {
    Vec2d courtyard;
    read_size(table, "courtyard_m", courtyard);
    if (!(courtyard.x < out.size_m.x && courtyard.y < out.size_m.y))
      throw usage_error(table.where("courtyard_m") + " must be smaller than size_m");
    if (out.roof != RoofKind::flat && out.roof != RoofKind::gable)
      throw usage_error(table.where("courtyard_m") + " needs a flat or gable roof");
    out.courtyard_m = courtyard;
  }
  return out;
}

Things read_things(const TomlTable& scene, const std::string& file) {
  Things out;
  for (const TomlTable& table : scene.tables("tree")) out.trees.push_back(read_tree(table, file));
  if (const auto table = scene.table("forest")) out.forest = read_forest(*table);
  for (const TomlTable& table : scene.tables("wall")) out.walls.push_back(read_wall(table, file));
  for (const TomlTable& table : scene.tables("bridge")) out.bridges.push_back(read_bridge(table, file));
  for (const TomlTable& table : scene.tables("mast")) out.masts.push_back(read_mast(table, file));
  for (const TomlTable& table : scene.tables("power_line")) out.power_lines.push_back(read_power_line(table, file));
  return out;
}

}  // namespace skysweep::scene
