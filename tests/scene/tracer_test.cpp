// SPDX-License-Identifier: Apache-2.0
#include "scene/world/tracer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr Box2d kExtent{{-100, -100}, {200, 200}};

const Solids nothing;

SolidBox turned_box() {
  SolidBox box;
  box.center = {40, 30};
  box.axis_u = {std::cos(0.3), std::sin(0.3)};
  box.half = {8, 5};
  box.z_low = -1;
  box.z_high = 12.34;
  return box;
}

SurfacePoint trace(const Tracer& tracer, Ray ray) {
  SurfacePoint hit;
  tracer.first_hits(&ray, 1, &hit);
  return hit;
}

TEST(Ground, stays_within_its_relief_and_its_slope_is_its_derivative) {
  const Ground ground({6, 50}, 4);
  Random random(1);
  double lowest = 0, highest = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec2d p{random.uniform(-500, 500), random.uniform(-500, 500)};
    const Ground::Sample here = ground.at(p);
    lowest = std::min(lowest, here.z);
    highest = std::max(highest, here.z);
    constexpr double kStep = 1e-4;
    EXPECT_NEAR(here.slope.x, (ground.at({p.x + kStep, p.y}).z - ground.at({p.x - kStep, p.y}).z) / (2 * kStep), 1e-7);
    EXPECT_NEAR(here.slope.y, (ground.at({p.x, p.y + kStep}).z - ground.at({p.x, p.y - kStep}).z) / (2 * kStep), 1e-7);
  }
  EXPECT_GE(lowest, -3);
  EXPECT_LE(highest, 3);
  EXPECT_GT(highest - lowest, 4);  // and makes use of it
}

TEST(Tracer, level_ground_is_exactly_at_zero) {
  const Ground ground({}, 1);
  const Tracer tracer(ground, nothing, kExtent);
  const SurfacePoint hit = trace(tracer, {{12.3, 45.6, 100}, {0.1, -0.2, -1}});
  EXPECT_EQ(hit.face, Face::ground);
  EXPECT_NEAR(hit.position.z, 0, 1e-12);
  EXPECT_NEAR(hit.position.x, 22.3, 1e-12);
  EXPECT_EQ(hit.normal, (Vec3d{0, 0, 1}));
}

TEST(Tracer, rolling_ground_is_met_where_its_closed_form_is) {
  const Ground ground({5, 40}, 9);
  const Tracer tracer(ground, nothing, kExtent);
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d direction{random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), -1};
    const SurfacePoint hit = trace(tracer, {{random.uniform(0, 100), random.uniform(0, 100), 100}, direction});
    ASSERT_EQ(hit.face, Face::ground);
    EXPECT_NEAR(hit.position.z, ground.at({hit.position.x, hit.position.y}).z, 1e-5);
  }
}

TEST(Tracer, a_roof_is_exactly_at_its_height_and_walls_are_exactly_in_their_plane) {
  const Ground ground({3, 40}, 9);
  const Solids solids{.boxes = {turned_box()}};
  const Tracer tracer(ground, solids, kExtent);
  const SurfacePoint roof = trace(tracer, {{41, 31, 90}, {0, 0, -1}});
  EXPECT_EQ(roof.face, Face::top);
  EXPECT_EQ(roof.position.z, 12.34);
  // From each side, level with the middle of the wall.
  const Vec2d sides[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const Vec2d side : sides) {
    const Vec2d outwards = side.x * solids.boxes[0].axis_u + side.y * solids.boxes[0].axis_v();
    const Vec2d start = solids.boxes[0].center + 50.0 * outwards;
    const SurfacePoint hit = trace(tracer, {{start.x, start.y, 6}, {-outwards.x, -outwards.y, 0}});
    ASSERT_EQ(hit.face, Face::wall);
    EXPECT_NEAR(dot(Vec2d{hit.normal.x, hit.normal.y}, outwards), 1, 1e-12);
    const double reach = side.x != 0 ? 8 : 5;
    EXPECT_NEAR(dot(Vec2d{hit.position.x, hit.position.y} - solids.boxes[0].center, outwards), reach, 1e-12);
  }
}

// Embree holds oneTBB to the number of threads that a device asks for, in the whole process.
// A gable and a ray straight down along it are parallel in double and meet in single precision.
TEST(Tracer, a_gable_met_edge_on_is_hit_at_a_finite_place) {
  const Ground ground({}, 1);
  Solids solids;
  const Vec2d along = heading_axis(17);
  const int body = solids.facets.add_body({BodyKind::wall, turned_box()});
  constexpr double kApart_m = 5, kLength_m = 10, kHeight_m = 6;
  const auto foot = [&](int wall) { return Vec2d{621.3, 402.9 + kApart_m * wall}; };
  constexpr int kWalls = 15;
  for (int wall = 0; wall < kWalls; ++wall) {
    const Vec2d p = foot(wall), q = p + kLength_m * along;
    const Vec2d ridge = p + 0.5 * kLength_m * along;
    solids.facets.add_polygon(
        {{p.x, p.y, -0.7}, {q.x, q.y, -0.7}, {q.x, q.y, 4.1}, {ridge.x, ridge.y, kHeight_m}, {p.x, p.y, 4.1}}, body,
        wall);
  }
  const Tracer tracer(ground, solids, {{500, 300}, {700, 500}});
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec2d p = foot(i % kWalls) + random.uniform(0, kLength_m) * along;
    const SurfacePoint hit = trace(tracer, {{p.x, p.y, 44}, {0, 0, -1}});
    ASSERT_TRUE(is_finite(hit.position)) << i;
    ASSERT_TRUE(hit.position.z > -0.71 && hit.position.z < kHeight_m + 0.01) << hit.position.z;
    hits += hit.face == Face::wall;
  }
  EXPECT_GT(hits, 0);
}

TEST(Tracer, leaves_all_threads_of_the_machine_to_others) {
  const auto allowed = [] { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); };
  const std::size_t before = allowed();
  const Ground ground({}, 1);
  const Tracer tracer(ground, {}, kExtent);
  EXPECT_EQ(allowed(), before);
}

TEST(Tracer, beyond_the_ground_there_is_nothing) {
  const Ground ground({}, 1);
  const Tracer tracer(ground, nothing, kExtent);
  EXPECT_EQ(trace(tracer, {{0, 0, 100}, {1, 0, 0.1}}).face, Face::none);
  EXPECT_EQ(trace(tracer, {{500, 0, 100}, {0, 0, -1}}).face, Face::none);
}

TEST(Tracer, a_building_blocks_the_way_only_as_far_as_the_ray_goes) {
  const Ground ground({}, 1);
  const Solids solids{.boxes = {turned_box()}};
  const Tracer tracer(ground, solids, kExtent);
  const Ray rays[] = {{{40, 80, 5}, {0, -30, 0}},    // ends before the wall
                      {{40, 80, 5}, {0, -100, 0}},   // ends behind it
                      {{40, 80, 20}, {0, -100, 0}},  // passes above
                      {{40, 80, 5}, {0, -100, 0}}};
  const bool active[] = {true, true, true, false};
  bool blocked[4];
  tracer.blocked(rays, active, 4, false, blocked);
  EXPECT_FALSE(blocked[0]);
  EXPECT_TRUE(blocked[1]);
  EXPECT_FALSE(blocked[2]);
  EXPECT_FALSE(blocked[3]);  // not asked
  tracer.blocked(rays, active, 1, true, blocked);
  EXPECT_TRUE(blocked[0]);  // without end it does meet the wall
}

}  // namespace
}  // namespace skysweep::scene
