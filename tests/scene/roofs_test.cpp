// SPDX-License-Identifier: Apache-2.0
#include "scene/world/roofs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/random.h"
#include "scene/world/tracer.h"

namespace skysweep::scene {
namespace {

constexpr Box2d kExtent{{-100, -100}, {200, 200}};
constexpr double kEaves = 6.1, kRidge = 9.7;

RoofedBuilding turned_building(RoofKind roof, Vec2d half) {
  RoofedBuilding out;
  out.walls.center = {40, 30};
  out.walls.axis_u = {std::cos(0.3), std::sin(0.3)};
  out.walls.half = half;
  out.walls.z_low = -1;
  out.walls.z_high = kEaves;
  out.roof = roof;
  out.ridge_z = kRidge;
  return out;
}

// Looks down, and obliquely, at random places of the building: heights must be those of the closed form, in the
// building's frame; outside and in the courtyard there is ground.
void expect_heights(const RoofedBuilding& building, const std::function<double(double u, double v)>& share) {
  const Ground ground({}, 1);
  Solids solids;
  add_building(solids.facets, building);
  const Tracer tracer(ground, solids, kExtent);
  const SolidBox& walls = building.walls;
  Random random(5);
  int on_roof = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec2d local{random.uniform(-1.2, 1.2) * walls.half.x, random.uniform(-1.2, 1.2) * walls.half.y};
    const Vec2d p = walls.from_local(local);
    SurfacePoint hit;
    const Ray down{{p.x, p.y, 100}, {0, 0, -1}};
    tracer.first_hits(&down, 1, &hit);
    const bool over = std::abs(local.x) < walls.half.x && std::abs(local.y) < walls.half.y;
    const bool hole = building.courtyard_half && std::abs(local.x) < building.courtyard_half->x &&
                      std::abs(local.y) < building.courtyard_half->y;
    if (!over || hole) {
      ASSERT_EQ(hit.face, Face::ground);
      continue;
    }
    ASSERT_EQ(hit.face, Face::top) << local.x << " " << local.y;
    ASSERT_NEAR(hit.position.z, kEaves + (kRidge - kEaves) * share(local.x, local.y), 1e-9);
    ++on_roof;

    const Ray oblique{{p.x + 40, p.y - 25, 100}, {random.uniform(-0.5, -0.3), random.uniform(0.2, 0.3), -1}};
    tracer.first_hits(&oblique, 1, &hit);
    if (hit.facet < 0 || hit.face != Face::top) continue;
    const Vec2d there = walls.local({hit.position.x, hit.position.y});
    ASSERT_NEAR(hit.position.z, kEaves + (kRidge - kEaves) * share(there.x, there.y), 1e-4);  // near ridges: the other
  }
  EXPECT_GT(on_roof, 1000);
}

TEST(Roofs, a_gable_has_the_heights_of_its_closed_form) {
  expect_heights(turned_building(RoofKind::gable, {8, 5}), [](double, double v) { return 1 - std::abs(v) / 5; });
}

TEST(Roofs, the_ridge_runs_along_the_longer_side) {
  expect_heights(turned_building(RoofKind::gable, {4, 7}), [](double u, double) { return 1 - std::abs(u) / 4; });
}

TEST(Roofs, a_hip_roof_has_one_slope_on_all_sides) {
  expect_heights(turned_building(RoofKind::hip, {8, 5}),
                 [](double u, double v) { return std::min(8 - std::abs(u), 5 - std::abs(v)) / 5; });
  expect_heights(turned_building(RoofKind::hip, {5, 5}),
                 [](double u, double v) { return std::min(5 - std::abs(u), 5 - std::abs(v)) / 5; });  // a pyramid
}

TEST(Roofs, a_shed_roof_rises_along_its_second_side) {
  expect_heights(turned_building(RoofKind::shed, {4, 7}), [](double, double v) { return (v + 7) / 14; });
}

TEST(Roofs, a_courtyard_is_open_to_the_ground_and_the_ridge_runs_around_it) {
  RoofedBuilding building = turned_building(RoofKind::gable, {9, 8});
  building.courtyard_half = Vec2d{4, 3};
  expect_heights(building, [](double u, double v) {
    // Wings are five metres wide all around: the wing of a place is where it lies farthest out.
    const double out = std::max(std::abs(u) - 4, std::abs(v) - 3);  // 0 at the courtyard's wall, 5 at the outer one
    return 1 - std::abs(out - 2.5) / 2.5;
  });
  building.roof = RoofKind::flat;
  expect_heights(building, [](double, double) { return 0.0; });
}

TEST(Roofs, a_gable_wall_is_met_exactly_in_its_plane_and_closed_up_to_the_ridge) {
  const Ground ground({}, 1);
  Solids solids;
  const RoofedBuilding building = turned_building(RoofKind::gable, {8, 5});
  add_building(solids.facets, building);
  const Tracer tracer(ground, solids, kExtent);
  const Vec2d outwards = building.walls.axis_u, start = building.walls.center + 50.0 * outwards;
  for (const double z : {0.5, 6.0, 6.2, 8.0, 9.6}) {
    SurfacePoint hit;
    const Ray level{{start.x, start.y, z}, {-outwards.x, -outwards.y, 0}};
    tracer.first_hits(&level, 1, &hit);
    ASSERT_EQ(hit.face, Face::wall) << z;
    EXPECT_NEAR(dot(Vec2d{hit.position.x, hit.position.y} - building.walls.center, outwards), 8, 1e-9);
  }
}

}  // namespace
}  // namespace skysweep::scene
