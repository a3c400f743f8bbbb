// SPDX-License-Identifier: Apache-2.0
#include "scene/world/thin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/world/surface_class.h"
#include "scene/world/tracer.h"

namespace skysweep::scene {
namespace {

constexpr Box2d kExtent{{-100, -100}, {200, 200}};

SurfacePoint look(const Tracer& tracer, Vec3d from, Vec3d direction) {
  const Ray ray{from, direction};
  SurfacePoint hit;
  tracer.first_hits(&ray, 1, &hit);
  return hit;
}
SurfacePoint look_down(const Tracer& tracer, Vec2d p) { return look(tracer, {p.x, p.y, 90}, {0, 0, -1}); }

TEST(Bridge, has_its_deck_above_free_space_and_ground_beneath) {
  const Ground ground({}, 1);
  Solids solids;
  add_bridge(solids.facets, {{10, 20}, {50, 32}, 6, 7.25, 1.2, 0}, ground);
  const Tracer tracer(ground, solids, kExtent);
  const SurfacePoint deck = look_down(tracer, {30, 26});
  EXPECT_EQ(deck.face, Face::top);
  EXPECT_EQ(deck.position.z, 7.25);
  EXPECT_EQ(class_of(deck, solids), SurfaceClass::roof);
  // Obliquely below the deck: ground right under it.
  const SurfacePoint below = look(tracer, {30 + 6, 26 - 18, 6.0}, {-6, 18, -6});
  EXPECT_EQ(below.face, Face::ground);
  EXPECT_NEAR(below.position.x, 30, 1e-9);
  EXPECT_NEAR(below.position.y, 26, 1e-9);
  // And from there upwards: the underside.
  const SurfacePoint underside = look(tracer, {30, 26, 1}, {0, 0, 1});
  EXPECT_EQ(underside.face, Face::wall);
  EXPECT_NEAR(underside.position.z, 6.05, 1e-12);
}

TEST(Bridge, a_ramp_falls_from_the_deck_to_the_ground) {
  const Ground ground({}, 1);
  Solids solids;
  add_bridge(solids.facets, {{10, 20}, {50, 20}, 6, 8, 1, 20}, ground);
  const Tracer tracer(ground, solids, kExtent);
  for (const double share : {0.1, 0.5, 0.9}) {
    EXPECT_NEAR(look_down(tracer, {50 + 20 * share, 21}).position.z, 8 * (1 - share), 1e-9);
    EXPECT_NEAR(look_down(tracer, {10 - 20 * share, 21}).position.z, 8 * (1 - share), 1e-9);
  }
  EXPECT_EQ(look_down(tracer, {71, 21}).face, Face::ground);
}

TEST(Thin, a_wire_is_found_from_above_all_along_at_the_height_of_its_parabola) {
  const Ground ground({}, 1);
  PowerLine line;
  line.pylons = {{10, 20}, {70, 35}, {120, 20}};
  line.height_m = 14;
  line.sag_m = 2;
  line.wires = 2;
  line.wire_spacing_m = 3;
  Solids solids;
  add_power_line(solids.facets, line, ground);
  const Tracer tracer(ground, solids, kExtent);
  // A wire's ends stand beside the pylons along cross arms: where the spans' directions bisect.
  const Vec2d first = (1 / norm(Vec2d{60, 15})) * Vec2d{60, 15}, second = (1 / norm(Vec2d{50, -15})) * Vec2d{50, -15};
  const Vec2d both = first + second, middle_along = (1 / norm(both)) * both;
  const Vec2d start = Vec2d{10, 20} - 1.5 * Vec2d{-first.y, first.x};
  const Vec2d end = Vec2d{70, 35} - 1.5 * Vec2d{-middle_along.y, middle_along.x};
  for (int i = 1; i < 60; ++i) {
    const double t = 0.02 + 0.96 * i / 60;
    const SurfacePoint hit = look_down(tracer, start + t * (end - start));
    ASSERT_EQ(class_of(hit, solids), SurfaceClass::thin) << t;
    const double parabola = 14 - 4 * 2 * t * (1 - t) + 0.5 * line.wire_diameter_m;
    EXPECT_NEAR(hit.position.z, parabola, 2. / (kWirePieces * kWirePieces));  // sagitta of one piece: sag / pieces^2
  }
  // At the joints the polyline is the parabola.
  const double t = 6. / kWirePieces;
  EXPECT_NEAR(look_down(tracer, start + t * (end - start)).position.z, 14 - 8 * t * (1 - t) + 0.015, 1e-9);
  const Vec2d across = (1 / norm(end - start)) * Vec2d{-(end - start).y, (end - start).x};
  EXPECT_EQ(look_down(tracer, start + 0.4 * (end - start) + 0.014 * across).face, Face::top);
  EXPECT_EQ(look_down(tracer, start + 0.4 * (end - start) + 0.016 * across).face, Face::ground);
  EXPECT_NEAR(look_down(tracer, {70, 35}).position.z, 14, 1e-12);  // a pylon
}

TEST(Thin, a_mast_is_exactly_as_high_above_its_ground_as_it_says) {
  const Ground ground({4, 30}, 3);
  Solids solids;
  add_mast(solids.facets, {{33, 44}, 17.5, 0.2}, ground);
  const Tracer tracer(ground, solids, kExtent);
  const SurfacePoint top = look_down(tracer, {33.09, 43.91});
  EXPECT_EQ(class_of(top, solids), SurfaceClass::thin);
  EXPECT_EQ(top.position.z, ground.at({33, 44}).z + 17.5);
  EXPECT_EQ(look_down(tracer, {33.11, 44}).face, Face::ground);
}

TEST(Thin, a_wall_follows_the_ground) {
  const Ground ground({2, 30}, 3);
  Solids solids;
  add_wall(solids.facets, {{0, 10}, {40, 30}, 2.5, 0.4}, ground);
  const Tracer tracer(ground, solids, kExtent);
  double lowest = 1e9, highest = -1e9;
  for (int i = 1; i < 100; ++i) {
    const Vec2d p = Vec2d{0, 10} + (i / 100.) * Vec2d{40, 20};
    const SurfacePoint hit = look_down(tracer, p);
    ASSERT_EQ(class_of(hit, solids), SurfaceClass::thin);
    EXPECT_NEAR(hit.position.z, ground.at(p).z + 2.5, 0.05);  // pieces of at most two metres
    lowest = std::min(lowest, hit.position.z);
    highest = std::max(highest, hit.position.z);
  }
  EXPECT_GT(highest - lowest, 0.5);
}

}  // namespace
}  // namespace skysweep::scene
