// SPDX-License-Identifier: Apache-2.0
#include "scene/world/town.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kTownStream = 0x70;

Vec2d heading_axis(double heading_deg) {  // east, turned clockwise
  const double heading = heading_deg * std::numbers::pi / 180;
  return {std::cos(heading), -std::sin(heading)};
}

// Lowest ground under the corners and the middle of a box, less a foundation that closes any gap.
double foundation_z(const SolidBox& box, const Ground& ground) {
  constexpr double kDepth = 1.0;
  double lowest = ground.at(box.center).z;
  for (const double u : {-1., 1.})
    for (const double v : {-1., 1.})
      lowest =
          std::min(lowest, ground.at(box.center + (u * box.half.x) * box.axis_u + (v * box.half.y) * box.axis_v()).z);
  return lowest - kDepth;
}

// Puts up one block. Lengths in the plan's frame are relative to the block's centre.
class BlockBuilder {
 public:
  BlockBuilder(const Town& town, const StreetPlan& streets, const Ground& ground, Vec2d block_center,
               std::uint64_t seed, std::vector<SolidBox>& boxes)
      : town_(town), streets_(streets), ground_(ground), center_(block_center), random_(seed), boxes_(boxes) {}

  void build() {
    const int lots_x = 1 + random_.below(2), lots_y = 1 + random_.below(2);
    const Vec2d lot{town_.block_m / lots_x, town_.block_m / lots_y};
    for (int j = 0; j < lots_y; ++j)
      for (int i = 0; i < lots_x; ++i)
        add_building({(i + 0.5) * lot.x - 0.5 * town_.block_m, (j + 0.5) * lot.y - 0.5 * town_.block_m}, lot);
    park_cars();
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

  void add_building(Vec2d lot_center, Vec2d lot) {
    constexpr double kEmptyLots = 0.12, kSmallestSetback = 2.0, kLargestSetback = 0.2;  // the last: of the lot
    if (random_.uniform() < kEmptyLots) return;
    const auto setback = [&](double side) {
      return random_.uniform(kSmallestSetback, std::max(kSmallestSetback, kLargestSetback * side));
    };
    const double west = setback(lot.x), east = setback(lot.x), south = setback(lot.y), north = setback(lot.y);
    const Vec2d half{0.5 * (lot.x - west - east), 0.5 * (lot.y - south - north)};
    if (!(half.x > 2 && half.y > 2)) return;
    SolidBox house = box(BoxKind::building, lot_center + 0.5 * Vec2d{west - east, south - north}, half);
    // Most buildings are low: the square of a uniform number.
    const double tall = std::pow(random_.uniform(), 2);
    const double ground_z = ground_.at(house.center).z;
    house.z_low = foundation_z(house, ground_);
    house.z_high = ground_z + town_.min_height_m + tall * (town_.max_height_m - town_.min_height_m);
    boxes_.push_back(house);
    add_roof_units(house);
  }

  void add_roof_units(const SolidBox& house) {
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
      boxes_.push_back(unit);
    }
  }

  // Along the four sides of the block, on the carriageway next to the pavement.
  void park_cars() {
    constexpr double kSpace = 6;  // metres of kerb a car takes
    const int spaces = static_cast<int>(town_.block_m / kSpace);
    const double taken = town_.cars_per_100m * kSpace / 100;
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i < spaces; ++i) {
        if (random_.uniform() >= taken) continue;
        const double along = (i + 0.5) * kSpace - 0.5 * town_.block_m + random_.uniform(-0.6, 0.6);
        const double across = 0.5 * town_.block_m + 0.2 * town_.street_m + 1.1;
        const Vec2d half{random_.uniform(1.9, 2.4), random_.uniform(0.8, 0.95)};
        const bool along_x = side < 2;
        const double sign = side % 2 ? -1 : 1;
        SolidBox car = box(BoxKind::car, along_x ? Vec2d{along, sign * across} : Vec2d{sign * across, along}, half);
        if (!along_x) car.axis_u = car.axis_v();
        car.z_low = foundation_z(car, ground_);
        car.z_high = ground_.at(car.center).z + random_.uniform(1.4, 1.9);
        boxes_.push_back(car);
      }
  }

  const Town& town_;
  const StreetPlan& streets_;
  const Ground& ground_;
  Vec2d center_;
  Random random_;
  std::vector<SolidBox>& boxes_;
};

}  // namespace

StreetPlan::StreetPlan(const Town& town, Vec2d middle)
    : block_m_(town.block_m),
      street_m_(town.street_m),
      per_pitch_(1 / pitch_m()),
      middle_(middle),
      axis_u_(heading_axis(town.heading_deg)),
      axis_v_{-axis_u_.y, axis_u_.x} {}

StreetPlan::Place StreetPlan::place(Vec2d q) const {
  const int x = floor_int(q.x * per_pitch_ + 0.5), y = floor_int(q.y * per_pitch_ + 0.5);
  const Vec2d in_block = q - pitch_m() * Vec2d{static_cast<double>(x), static_cast<double>(y)};
  return {x,
          y,
          in_block,
          {std::max(0.0, std::abs(in_block.x) - 0.5 * block_m_), std::max(0.0, std::abs(in_block.y) - 0.5 * block_m_)}};
}

std::vector<SolidBox> build_boxes(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets,
                                  const Box2d& extent) {
  std::vector<SolidBox> boxes;
  for (const Building& building : scene.buildings) {
    SolidBox box;
    box.center = building.center;
    box.axis_u = heading_axis(building.heading_deg);
    box.half = 0.5 * building.size_m;
    box.z_high = building.roof_z_m;
    box.z_low = std::min(foundation_z(box, ground), building.roof_z_m - 0.01);
    box.seed = static_cast<std::uint32_t>(mix64(scene.seed + boxes.size()));
    boxes.push_back(box);
  }
  if (!scene.town) return boxes;

  Box2d in_plan;
  for (const Vec2d corner : {extent.min, extent.max, Vec2d{extent.min.x, extent.max.y}, {extent.max.x, extent.min.y}})
    in_plan.extend(streets->to_plan(corner));
  const StreetPlan::Place first = streets->place(in_plan.min), last = streets->place(in_plan.max);
  for (int y = first.block_y; y <= last.block_y; ++y)
    for (int x = first.block_x; x <= last.block_x; ++x) {
      const Vec2d center = streets->pitch_m() * Vec2d{static_cast<double>(x), static_cast<double>(y)};
      if (!extent.contains(streets->from_plan(center))) continue;
      const auto address =
          (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
      BlockBuilder(*scene.town, *streets, ground, center, mix64(mix64(scene.seed) ^ kTownStream) ^ mix64(address),
                   boxes)
          .build();
    }
  return boxes;
}

}  // namespace skysweep::scene
