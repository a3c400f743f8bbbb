// SPDX-License-Identifier: Apache-2.0
#include "scene/world/town.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "scene/world/noise.h"
#include "scene/world/roofs.h"
#include "scene/world/solids.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kTownStream = 0x70;

// Roof kinds, courtyards and trees draw from this one, so that towns without them keep every byte.
constexpr std::uint64_t kExtrasStream = 0x71;

// Puts up one block. Lengths in the plan's frame are relative to the block's centre.
class BlockBuilder {
 public:
  BlockBuilder(const Town& town, const StreetPlan& streets, const Ground& ground, Vec2d block_center,
               std::uint64_t seed, Solids& solids)
      : town_(town),
        streets_(streets),
        ground_(ground),
        block_(streets.block_m()),
        center_(block_center),
        random_(seed),
        extras_(mix64(seed) ^ kExtrasStream),
        solids_(solids) {}

  void build(bool with_buildings) {
    if (with_buildings) add_buildings();
    park_cars();
    plant_trees();
  }

 private:
  SolidBox box(BoxKind kind, Vec2d where, Vec2d half) {
    SolidBox out;
    out.kind = kind;
    out.center = streets_.from_plan(center_ + where);
    out.axis_u = streets_.axis_u();
    out.half = half;
    out.seed = static_cast<std::uint32_t>(random_.next());
    return out;
  }

  void add_buildings() {
    int lots_x = 1 + random_.below(2);
    const int lots_y = 1 + random_.below(2);
    const bool dense = town_.alley_m > 0;
    if (dense) lots_x = 2;
    const Vec2d lot{block_.x / lots_x, block_.y / lots_y};
    for (int j = 0; j < lots_y; ++j)
      for (int i = 0; i < lots_x; ++i) {
        const Vec2d lot_center{(i + 0.5) * lot.x - 0.5 * block_.x, (j + 0.5) * lot.y - 0.5 * block_.y};
        constexpr double kEmptyLots = 0.12, kEmptyLotsIfDense = 0.04;
        if (random_.uniform() < (dense ? kEmptyLotsIfDense : kEmptyLots)) continue;
        if (dense)
          add_along_alleys(lot_center, lot, {1.0 * i / std::max(1, lots_x - 1), 1.0 * j / std::max(1, lots_y - 1)},
                           {lots_x > 1, lots_y > 1});
        else
          add_with_setbacks(lot_center, lot);
      }
  }

  // To the street on its outer sides, half an alley from the lots beside it. `side`: 0 for the first lot of a row or
  // column, 1 for the last; `shared`: whether there is more than one.
  struct Shared {
    bool x, y;
  };
  void add_along_alleys(Vec2d lot_center, Vec2d lot, Vec2d side, Shared shared) {
    const double cut_x = shared.x ? 0.5 * town_.alley_m : 0, cut_y = shared.y ? 0.5 * town_.alley_m : 0;
    const Vec2d half{0.5 * (lot.x - cut_x), 0.5 * (lot.y - cut_y)};
    add_building(lot_center + Vec2d{(side.x - 0.5) * cut_x, (side.y - 0.5) * cut_y}, half);
  }

  void add_with_setbacks(Vec2d lot_center, Vec2d lot) {
    constexpr double kSmallestSetback = 2.0, kLargestSetback = 0.2;  // the last: of the lot
    const auto setback = [&](double side) {
      return random_.uniform(kSmallestSetback, std::max(kSmallestSetback, kLargestSetback * side));
    };
    const double west = setback(lot.x), east = setback(lot.x), south = setback(lot.y), north = setback(lot.y);
    const Vec2d half{0.5 * (lot.x - west - east), 0.5 * (lot.y - south - north)};
    add_building(lot_center + 0.5 * Vec2d{west - east, south - north}, half);
  }

  void add_building(Vec2d where, Vec2d half) {
    if (!(half.x > 2 && half.y > 2)) return;
    SolidBox house = box(BoxKind::building, where, half);
    // Most buildings are low: the square of a uniform number.
    const double tall = std::pow(random_.uniform(), 2);
    const double ground_z = ground_.at(house.center).z;
    house.z_low = foundation_z(house, ground_);
    house.z_high = ground_z + town_.min_height_m + tall * (town_.max_height_m - town_.min_height_m);
    RoofedBuilding shape;
    shape.walls = house;
    shape.roof = draw_roof(house, ground_z);
    shape.courtyard_half = draw_courtyard(house, shape.roof);
    if (shape.roof != RoofKind::flat) {
      constexpr double kHighestRise = 6;
      const double wing =
          shape.courtyard_half ? 0.5 * (house.half.x - shape.courtyard_half->x) : std::min(house.half.x, house.half.y);
      const double slope = extras_.uniform(0.5, 0.9) * (shape.roof == RoofKind::shed ? 0.5 : 1);
      shape.ridge_z = house.z_high + std::min(kHighestRise, slope * wing);
      if (shape.walls.seed % 3 == 0) ++shape.walls.seed;  // gravel would not stay on it: tiles
    }
    buildings_.push_back(house);
    if (shape.roof == RoofKind::flat && !shape.courtyard_half)
      solids_.boxes.push_back(house);
    else
      add_building_facets(shape);
    add_roof_units(house, shape);
  }

  void add_building_facets(const RoofedBuilding& shape) { scene::add_building(solids_.facets, shape); }

  RoofKind draw_roof(const SolidBox& house, double ground_z) {
    constexpr double kWidest = 18;  // across the ridge
    const double draw = extras_.uniform();
    if (house.z_high - ground_z > town_.pitched_up_to_m || 2 * std::min(house.half.x, house.half.y) > kWidest)
      return RoofKind::flat;
    if (draw < town_.gable_share) return RoofKind::gable;
    if (draw < town_.gable_share + town_.hip_share) return RoofKind::hip;
    if (draw < town_.gable_share + town_.hip_share + town_.shed_share) return RoofKind::shed;
    return RoofKind::flat;
  }

  std::optional<Vec2d> draw_courtyard(const SolidBox& house, RoofKind roof) {
    constexpr double kSmallestHalf = 2.5;
    const double draw = extras_.uniform(), wing = extras_.uniform(4.5, 6);
    if (draw >= town_.courtyard_share || roof == RoofKind::hip || roof == RoofKind::shed) return std::nullopt;
    const Vec2d half{house.half.x - wing, house.half.y - wing};
    if (!(half.x > kSmallestHalf && half.y > kSmallestHalf)) return std::nullopt;
    return half;
  }

  void add_roof_units(const SolidBox& house, const RoofedBuilding& shape) {
    const int count = static_cast<int>(std::floor(2 * town_.roof_units * random_.uniform() + 0.5));
    for (int i = 0; i < count; ++i) {
      SolidBox unit = house;
      unit.kind = BoxKind::roof_unit;
      unit.half = {random_.uniform(0.4, 1.6), random_.uniform(0.4, 1.6)};
      const double u = random_.uniform(-0.8, 0.8) * (house.half.x - unit.half.x);
      const double v = random_.uniform(-0.8, 0.8) * (house.half.y - unit.half.y);
      unit.center = house.center + u * house.axis_u + v * house.axis_v();
      unit.z_low = house.z_high - 0.2;
      unit.z_high = house.z_high + random_.uniform(0.5, 2.2);
      unit.seed = static_cast<std::uint32_t>(random_.next());
      if (shape.courtyard_half && !stands_on_wing({u, v}, unit.half, *shape.courtyard_half)) continue;
      if (shape.roof != RoofKind::flat) make_chimney(unit, shape);
      solids_.boxes.push_back(unit);
    }
  }

  static bool stands_on_wing(Vec2d where, Vec2d half, Vec2d courtyard_half) {
    return std::abs(where.x) - half.x > courtyard_half.x || std::abs(where.y) - half.y > courtyard_half.y;
  }

  // Narrow, and from inside the roof to above its ridge.
  static void make_chimney(SolidBox& unit, const RoofedBuilding& shape) {
    constexpr double kNarrower = 0.35, kAboveRidge = 0.4;
    unit.half = kNarrower * unit.half;
    unit.z_low = shape.walls.z_high - 0.2;
    unit.z_high = shape.ridge_z + kAboveRidge;
  }

  // Along the four sides of the block, on the carriageway next to the pavement.
  void park_cars() {
    constexpr double kSpace = 6;  // metres of kerb a car takes
    const double taken = town_.cars_per_100m * kSpace / 100;
    for (int side = 0; side < 4; ++side) {
      const bool along_x = side < 2;
      const double length = along_x ? block_.x : block_.y, depth = along_x ? block_.y : block_.x;
      for (int i = 0; i < static_cast<int>(length / kSpace); ++i) {
        if (random_.uniform() >= taken) continue;
        const double along = (i + 0.5) * kSpace - 0.5 * length + random_.uniform(-0.6, 0.6);
        const double across = 0.5 * depth + 0.2 * town_.street_m + 1.1;
        const Vec2d half{random_.uniform(1.9, 2.4), random_.uniform(0.8, 0.95)};
        const double sign = side % 2 ? -1 : 1;
        SolidBox car = box(BoxKind::car, along_x ? Vec2d{along, sign * across} : Vec2d{sign * across, along}, half);
        if (!along_x) car.axis_u = car.axis_v();
        car.z_low = foundation_z(car, ground_);
        car.z_high = ground_.at(car.center).z + random_.uniform(1.4, 1.9);
        solids_.boxes.push_back(car);
      }
    }
  }

  // Where no building of the block is in the way; a tree that finds no place in a few tries is left out.
  void plant_trees() {
    constexpr int kTries = 8;
    if (!(town_.trees_per_block > 0)) return;
    const int count = static_cast<int>(std::floor(2 * town_.trees_per_block * extras_.uniform() + 0.5));
    for (int i = 0; i < count; ++i) {
      const double height = extras_.uniform(4, 10), crown = height * extras_.uniform(0.45, 0.65);
      const auto shape = static_cast<CrownShape>(extras_.below(8) < 6 ? 0 : extras_.below(3));
      const std::uint64_t seed = extras_.next();
      for (int t = 0; t < kTries; ++t) {
        const Vec2d p = streets_.from_plan(
            center_ + Vec2d{extras_.uniform(-0.5, 0.5) * block_.x, extras_.uniform(-0.5, 0.5) * block_.y});
        if (!clear_of_buildings(p, 0.5 * crown)) continue;
        solids_.trees.push_back(plant(shape, {p.x, p.y, ground_.at(p).z}, height, crown, seed));
        break;
      }
    }
  }

  bool clear_of_buildings(Vec2d p, double radius) const {
    for (const SolidBox& house : buildings_) {
      const Vec2d q = house.local(p);
      if (std::abs(q.x) < house.half.x + radius && std::abs(q.y) < house.half.y + radius) return false;
    }
    return true;
  }

  const Town& town_;
  const StreetPlan& streets_;
  const Ground& ground_;
  Vec2d block_;  // its sides
  Vec2d center_;
  Random random_, extras_;
  Solids& solids_;
  std::vector<SolidBox> buildings_;
};

}  // namespace

StreetPlan::StreetPlan(const Town& town, Vec2d middle)
    : block_m_{town.block_m, town.block_depth_m > 0 ? town.block_depth_m : town.block_m},
      street_m_(town.street_m),
      per_pitch_{1 / pitch_m().x, 1 / pitch_m().y},
      middle_(middle),
      axis_u_(heading_axis(town.heading_deg)),
      axis_v_{-axis_u_.y, axis_u_.x} {}

StreetPlan::Place StreetPlan::place(Vec2d q) const {
  const int x = floor_int(q.x * per_pitch_.x + 0.5), y = floor_int(q.y * per_pitch_.y + 0.5);
  const Vec2d in_block = q - block_center(x, y);
  return {
      x,
      y,
      in_block,
      {std::max(0.0, std::abs(in_block.x) - 0.5 * block_m_.x), std::max(0.0, std::abs(in_block.y) - 0.5 * block_m_.y)}};
}

void build_town(const Scene& scene, const StreetPlan& streets, const Ground& ground, const Box2d& extent,
                Solids& solids) {
  Box2d in_plan;
  for (const Vec2d corner : {extent.min, extent.max, Vec2d{extent.min.x, extent.max.y}, {extent.max.x, extent.min.y}})
    in_plan.extend(streets.to_plan(corner));
  const StreetPlan::Place first = streets.place(in_plan.min), last = streets.place(in_plan.max);
  for (int y = first.block_y; y <= last.block_y; ++y)
    for (int x = first.block_x; x <= last.block_x; ++x) {
      const Vec2d center = streets.block_center(x, y), middle = streets.from_plan(center);
      if (!extent.contains(middle)) continue;
      const auto address =
          (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
      const std::optional<Forest>& forest = scene.things.forest;
      const bool wooded = forest && (!forest->area || forest->area->contains(middle));
      BlockBuilder(*scene.town, streets, ground, center, mix64(mix64(scene.seed) ^ kTownStream) ^ mix64(address),
                   solids)
          .build(!wooded);
    }
}

}  // namespace skysweep::scene
