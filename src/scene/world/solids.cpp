// SPDX-License-Identifier: Apache-2.0
#include "scene/world/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "scene/world/noise.h"
#include "scene/world/roofs.h"
#include "scene/world/thin.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kForestStream = 0x72, kThingStream = 0x73;

void add_buildings(const Scene& scene, const Ground& ground, Solids& solids) {
  for (const Building& building : scene.buildings) {
    const bool level = building.roof == RoofKind::flat;
    SolidBox box;
    box.center = building.center;
    box.axis_u = heading_axis(building.heading_deg);
    box.half = 0.5 * building.size_m;
    box.z_high = level ? building.roof_z_m : building.eaves_z_m;
    box.z_low = std::min(foundation_z(box, ground), box.z_high - 0.01);
    box.seed =
        static_cast<std::uint32_t>(mix64(scene.seed + static_cast<std::uint64_t>(&building - &scene.buildings[0])));
    if (level && !building.courtyard_m) {
      solids.boxes.push_back(box);
      continue;
    }
    std::optional<Vec2d> courtyard;
    if (building.courtyard_m) courtyard = 0.5 * *building.courtyard_m;
    if (!level && box.seed % 3 == 0) ++box.seed;  // gravel would not stay on it: tiles
    add_building(solids.facets, {box, building.roof, building.roof_z_m, courtyard, building.teeth, building.steep_deg});
  }
}

void add_trees(const Scene& scene, const Ground& ground, Solids& solids) {
  for (const Tree& tree : scene.things.trees)
    solids.trees.push_back(plant(tree.shape, {tree.position.x, tree.position.y, ground.at(tree.position).z},
                                 tree.height_m, tree.crown_m,
                                 mix64(mix64(scene.seed) ^ kThingStream) ^ mix64(solids.trees.size())));
}

// One tree somewhere in each cell of a grid: random, but nowhere too dense or bare.
void grow_forest(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets,
                 const Box2d& extent, std::vector<TreeInstance>& trees) {
  const Forest& forest = *scene.things.forest;
  const double spacing = 100 / std::sqrt(forest.trees_per_ha);
  constexpr std::array<double, 3> kCrownToHeight = {0.55, 0.36, 0.28};  // of CrownShape
  Box2d wanted = extent;
  if (forest.area) {
    wanted.min = {std::max(extent.min.x, forest.area->min.x), std::max(extent.min.y, forest.area->min.y)};
    wanted.max = {std::min(extent.max.x, forest.area->max.x), std::min(extent.max.y, forest.area->max.y)};
  }
  for (int j = floor_int(wanted.min.y / spacing); j <= floor_int(wanted.max.y / spacing); ++j)
    for (int i = floor_int(wanted.min.x / spacing); i <= floor_int(wanted.max.x / spacing); ++i) {
      const auto address =
          (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32) | static_cast<std::uint32_t>(j);
      Random random(mix64(mix64(scene.seed) ^ kForestStream) ^ mix64(address));
      const Vec2d p = spacing * Vec2d{i + random.uniform(0.05, 0.95), j + random.uniform(0.05, 0.95)};
      const double height = random.uniform(forest.min_height_m, forest.max_height_m);
      const CrownShape shape =
          forest.shapes[static_cast<std::size_t>(random.below(static_cast<int>(forest.shapes.size())))];
      const double crown = kCrownToHeight[static_cast<std::size_t>(shape)] * height * random.uniform(0.8, 1.2);
      if (!wanted.contains(p)) continue;
      if (streets) {
        const StreetPlan::Place place = streets->place(streets->to_plan(p));
        const Vec2d middle = streets->from_plan(streets->block_center(place.block_x, place.block_y));
        const bool in_street = std::max(place.outside.x, place.outside.y) > 0;
        if (in_street || (forest.area && !forest.area->contains(middle))) continue;
      }
      trees.push_back(plant(shape, {p.x, p.y, ground.at(p).z}, height, crown, random.next()));
    }
}

double highest_of(const Things& things) {
  double highest = 0;
  const auto reach = [&highest](double height) { highest = std::max(highest, height); };
  for (const Tree& tree : things.trees) reach(tree.height_m);
  if (things.forest) reach(things.forest->max_height_m);
  for (const FreeWall& wall : things.walls) reach(wall.height_m);
  for (const Bridge& bridge : things.bridges) reach(bridge.deck_z_m);
  for (const Mast& mast : things.masts) reach(mast.height_m);
  for (const PowerLine& line : things.power_lines) reach(line.height_m + line.wire_diameter_m);
  return highest;
}

}  // namespace

double foundation_z(const SolidBox& box, const Ground& ground) {
  constexpr double kDepth = 1.0;
  double lowest = ground.at(box.center).z;
  for (const double u : {-1., 1.})
    for (const double v : {-1., 1.})
      lowest =
          std::min(lowest, ground.at(box.center + (u * box.half.x) * box.axis_u + (v * box.half.y) * box.axis_v()).z);
  return lowest - kDepth;
}

double Solids::highest_m() const {
  double highest = std::numeric_limits<double>::lowest();
  for (const SolidBox& box : boxes) highest = std::max(highest, box.z_high);
  for (const Facet& facet : facets.all)
    for (const Vec3d& corner : facet.corner) highest = std::max(highest, corner.z);
  for (const TreeInstance& tree : trees) highest = std::max(highest, tree.foot.z + tree.height_m);
  return highest;
}

Solids build_solids(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets,
                    const Box2d& extent) {
  Solids out;
  add_buildings(scene, ground, out);
  if (scene.town) build_town(scene, *streets, ground, extent, out);
  add_trees(scene, ground, out);
  if (scene.things.forest) grow_forest(scene, ground, streets, extent, out.trees);
  for (const FreeWall& wall : scene.things.walls) add_wall(out.facets, wall, ground);
  for (const Bridge& bridge : scene.things.bridges) add_bridge(out.facets, bridge, ground);
  for (const Mast& mast : scene.things.masts) add_mast(out.facets, mast, ground);
  for (const PowerLine& line : scene.things.power_lines) add_power_line(out.facets, line, ground);
  return out;
}

double tallest_object_m(const Scene& scene) {
  constexpr double kRoofAboveEaves = 6.5;  // with its chimneys
  double highest = highest_of(scene.things);
  if (scene.town) {
    const Town& town = *scene.town;
    highest = std::max(highest, town.max_height_m);
    if (town.gable_share + town.hip_share + town.shed_share > 0)
      highest = std::max(highest, std::min(town.max_height_m, town.pitched_up_to_m) + kRoofAboveEaves);
    if (town.trees_per_block > 0) highest = std::max(highest, 10.0);
  }
  return highest;
}

}  // namespace skysweep::scene
