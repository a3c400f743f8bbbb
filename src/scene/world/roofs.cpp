// SPDX-License-Identifier: Apache-2.0
#include "scene/world/roofs.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/check.h"

namespace skysweep::scene {
namespace {

// Puts faces up in the frame of one building.
class Builder {
 public:
  Builder(Facets& facets, const SolidBox& walls) : Builder(facets, walls, {BodyKind::building, walls}) {}
  // Of a part of it that has looks of its own.
  Builder(Facets& facets, const SolidBox& walls, const Body& part)
      : facets_(facets), walls_(walls), body_(facets.add_body(part)) {}

  void face(std::initializer_list<Vec3d> local) {
    std::vector<Vec3d> corners;
    for (const Vec3d& q : local) {
      const Vec2d p = walls_.from_local({q.x, q.y});
      corners.push_back({p.x, p.y, q.z});
    }
    facets_.add_polygon(corners, body_, faces_++);
  }

 private:
  Facets& facets_;
  const SolidBox& walls_;
  int body_, faces_ = 0;
};

void add_gable(Builder& build, double a, double b, double low, double eaves, double ridge) {
  build.face({{-a, -b, eaves}, {a, -b, eaves}, {a, 0, ridge}, {-a, 0, ridge}});
  build.face({{a, b, eaves}, {-a, b, eaves}, {-a, 0, ridge}, {a, 0, ridge}});
  build.face({{-a, -b, low}, {a, -b, low}, {a, -b, eaves}, {-a, -b, eaves}});
  build.face({{a, b, low}, {-a, b, low}, {-a, b, eaves}, {a, b, eaves}});
  build.face({{a, -b, low}, {a, b, low}, {a, b, eaves}, {a, 0, ridge}, {a, -b, eaves}});
  build.face({{-a, b, low}, {-a, -b, low}, {-a, -b, eaves}, {-a, 0, ridge}, {-a, b, eaves}});
}

void add_hip(Builder& build, double a, double b, double low, double eaves, double ridge) {
  const double end = a - b;  // of the ridge
  build.face({{-a, -b, eaves}, {a, -b, eaves}, {end, 0, ridge}, {-end, 0, ridge}});
  build.face({{a, -b, eaves}, {a, b, eaves}, {end, 0, ridge}});
  build.face({{a, b, eaves}, {-a, b, eaves}, {-end, 0, ridge}, {end, 0, ridge}});
  build.face({{-a, b, eaves}, {-a, -b, eaves}, {-end, 0, ridge}});
  build.face({{-a, -b, low}, {a, -b, low}, {a, -b, eaves}, {-a, -b, eaves}});
  build.face({{a, -b, low}, {a, b, low}, {a, b, eaves}, {a, -b, eaves}});
  build.face({{a, b, low}, {-a, b, low}, {-a, b, eaves}, {a, b, eaves}});
  build.face({{-a, b, low}, {-a, -b, low}, {-a, -b, eaves}, {-a, b, eaves}});
}

void add_shed(Builder& build, double a, double b, double low, double eaves, double ridge) {
  build.face({{-a, -b, eaves}, {a, -b, eaves}, {a, b, ridge}, {-a, b, ridge}});
  build.face({{-a, -b, low}, {a, -b, low}, {a, -b, eaves}, {-a, -b, eaves}});
  build.face({{a, -b, low}, {a, b, low}, {a, b, ridge}, {a, -b, eaves}});
  build.face({{a, b, low}, {-a, b, low}, {-a, b, ridge}, {a, b, ridge}});
  build.face({{-a, b, low}, {-a, -b, low}, {-a, -b, eaves}, {-a, b, ridge}});
}

// Each tooth is a body of its own, with the same seed: so they all look alike.
void add_saw_teeth(Facets& facets, const RoofedBuilding& building) {
  const double a = building.walls.half.x, b = building.walls.half.y;
  const double low = building.walls.z_low, eaves = building.walls.z_high, ridge = building.ridge_z;
  const double width = 2 * b / building.teeth;
  const double steep_run =
      building.steep_deg < 90 ? (ridge - eaves) / std::tan(building.steep_deg * std::numbers::pi / 180) : 0;
  SKY_CHECK(building.teeth > 0 && steep_run < width);
  const auto valley = [&](int k) { return k == building.teeth ? b : -b + k * width; };
  for (int k = 0; k < building.teeth; ++k) {
    const double from = valley(k), to = valley(k + 1), top = to - steep_run;
    SolidBox place = building.walls;
    place.center = building.walls.from_local({0, 0.5 * (from + to)});
    place.half.y = 0.5 * (to - from);
    Builder build(facets, building.walls, {BodyKind::building, place});
    build.face({{-a, from, eaves}, {a, from, eaves}, {a, top, ridge}, {-a, top, ridge}});
    build.face({{a, from, low}, {a, to, low}, {a, to, eaves}, {a, top, ridge}, {a, from, eaves}});
    build.face({{-a, to, low}, {-a, from, low}, {-a, from, eaves}, {-a, top, ridge}, {-a, to, eaves}});
    if (k == 0) build.face({{-a, from, low}, {a, from, low}, {a, from, eaves}, {-a, from, eaves}});
    if (k + 1 == building.teeth) build.face({{a, to, low}, {-a, to, low}, {-a, to, eaves}, {a, to, eaves}});
    Builder glazing(facets, building.walls, {BodyKind::glazing, place});
    glazing.face({{a, to, eaves}, {-a, to, eaves}, {-a, top, ridge}, {a, top, ridge}});
  }
}

// Four wings around a courtyard, mitred at the corners.
void add_ring(Builder& build, Vec2d outer, Vec2d inner, double low, double eaves, double ridge) {
  const Vec2d middle = 0.5 * (outer + inner);
  constexpr std::array<Vec2d, 4> kSigns = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const auto corner = [&](std::size_t k, Vec2d half, double z) {
    return Vec3d{kSigns[k % 4].x * half.x, kSigns[k % 4].y * half.y, z};
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t n = k + 1;
    build.face({corner(k, outer, eaves), corner(n, outer, eaves), corner(n, middle, ridge), corner(k, middle, ridge)});
    build.face({corner(k, middle, ridge), corner(n, middle, ridge), corner(n, inner, eaves), corner(k, inner, eaves)});
    build.face({corner(k, outer, low), corner(n, outer, low), corner(n, outer, eaves), corner(k, outer, eaves)});
    build.face({corner(n, inner, low), corner(k, inner, low), corner(k, inner, eaves), corner(n, inner, eaves)});
  }
}

// The same walls with the longer side along u.
SolidBox along_longer_side(SolidBox walls) {
  if (walls.half.x >= walls.half.y) return walls;
  walls.axis_u = walls.axis_v();
  std::swap(walls.half.x, walls.half.y);
  return walls;
}

}  // namespace

void add_building(Facets& facets, const RoofedBuilding& building) {
  const bool has_ridge = building.roof != RoofKind::flat;
  SKY_CHECK(!has_ridge || building.ridge_z > building.walls.z_high);
  const double low = building.walls.z_low, eaves = building.walls.z_high;
  const double ridge = has_ridge ? building.ridge_z : eaves;
  if (building.courtyard_half) {
    SKY_CHECK(!has_ridge || building.roof == RoofKind::gable);
    Builder build(facets, building.walls);
    add_ring(build, building.walls.half, *building.courtyard_half, low, eaves, ridge);
    return;
  }
  SKY_CHECK(has_ridge);  // a level roof without a hole is a box
  if (building.roof == RoofKind::saw_tooth) {
    add_saw_teeth(facets, building);
    return;
  }
  const SolidBox walls = building.roof == RoofKind::shed ? building.walls : along_longer_side(building.walls);
  Builder build(facets, walls);
  if (building.roof == RoofKind::gable) add_gable(build, walls.half.x, walls.half.y, low, eaves, ridge);
  if (building.roof == RoofKind::hip) add_hip(build, walls.half.x, walls.half.y, low, eaves, ridge);
  if (building.roof == RoofKind::shed) add_shed(build, walls.half.x, walls.half.y, low, eaves, ridge);
}

}  // namespace skysweep::scene
