// SPDX-License-Identifier: Apache-2.0
#include "scene/world/roofs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.h"
#include "scene/world/tracer.h"
#include "scene/world/world.h"

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

RoofedBuilding saw_tooth(int teeth, double steep_deg) {
  RoofedBuilding out = turned_building(RoofKind::saw_tooth, {8, 15});
  out.teeth = teeth;
  out.steep_deg = steep_deg;
  return out;
}

TEST(Roofs, a_saw_tooth_roof_rises_slowly_and_falls_steeply_tooth_by_tooth) {
  for (const double steep_deg : {90., 70., 60.})
    for (const int teeth : {1, 5}) {
      const double width = 30. / teeth;
      const double run =
          steep_deg < 90 ? width - (kRidge - kEaves) / std::tan(steep_deg * std::numbers::pi / 180) : width;
      expect_heights(saw_tooth(teeth, steep_deg), [&](double, double v) {
        const double t = v + 15 - width * std::floor((v + 15) / width);
        return t < run ? t / run : (width - t) / (width - run);
      });
    }
}

TEST(Roofs, the_upright_glass_of_a_saw_tooth_roof_is_met_in_its_plane_and_the_gable_ends_are_closed) {
  const Ground ground({}, 1);
  Solids solids;
  const RoofedBuilding building = saw_tooth(5, 90);
  add_building(solids.facets, building);
  const Tracer tracer(ground, solids, kExtent);
  const auto look_along = [&](Vec2d from, Vec2d along, double z) {
    const Vec2d p = building.walls.from_local(from);
    const Vec2d d = along.x * building.walls.axis_u + along.y * building.walls.axis_v();
    SurfacePoint hit;
    const Ray level{{p.x, p.y, z}, {d.x, d.y, 0}};
    tracer.first_hits(&level, 1, &hit);
    return hit;
  };
  // From between two ridges towards the ridge before: the glass of the second tooth is at v = -3.
  const SurfacePoint glass = look_along({1, 0}, {0, -1}, 9);
  ASSERT_EQ(glass.face, Face::wall);
  EXPECT_NEAR(building.walls.local({glass.position.x, glass.position.y}).y, -3, 1e-9);
  EXPECT_EQ(
      solids.facets.bodies[static_cast<std::size_t>(solids.facets.all[static_cast<std::size_t>(glass.facet)].body)]
          .kind,
      BodyKind::glazing);
  EXPECT_EQ(class_of(glass, solids), SurfaceClass::facade_edge);
  // The end of a tooth closes it as high as its flat face reaches there.
  for (const double v : {-2., 0., 2., 2.9}) {
    const double top = kEaves + (kRidge - kEaves) * (v + 3) / 6;
    const SurfacePoint below = look_along({30, v}, {-1, 0}, top - 0.01),
                       above = look_along({30, v}, {-1, 0}, top + 0.01);
    ASSERT_EQ(below.face, Face::wall) << v;
    EXPECT_NEAR(building.walls.local({below.position.x, below.position.y}).x, 8, 1e-9);
    EXPECT_EQ(above.face, Face::none) << v;
  }
}

// That all teeth look alike, to the last stain, is what makes them hard to match.
TEST(Roofs, saw_teeth_look_alike) {
  Scene scene;
  scene.area_m = {60, 60};
  Building factory;
  factory.center = {30, 30};
  factory.size_m = {16, 30};
  factory.roof = RoofKind::saw_tooth;
  factory.teeth = 5;
  factory.steep_deg = 75;
  factory.eaves_z_m = 5;
  factory.roof_z_m = 8;
  scene.buildings = {factory};
  scene.camera = camera::camera_from_sensor(10, 10, 120, 90);
  scene.light.shadows = false;
  const World world(scene, {{0, 0}, {60, 60}});
  for (int i = 0; i < 200; ++i) {
    const double x = 23 + 0.07 * i, y = 15.1 + 0.029 * i;
    SurfacePoint hit[5];
    LinearRgb light[5];
    Ray down[5];
    for (int k = 0; k < 5; ++k) down[k] = {{x, y + 6 * k, 100}, {0, 0, -1}};
    world.look(down, 5, hit, light);
    for (int k = 1; k < 5; ++k) {
      EXPECT_EQ(world.surface_class(hit[k]), SurfaceClass::roof);
      EXPECT_NEAR(light[k].g, light[0].g, 1e-3) << i << " " << k;
    }
  }
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
