// SPDX-License-Identifier: Apache-2.0
// Rays against ground of every kind, against a marcher that knows nothing but heights: small steps, then bisection.
#include "scene/world/terrain/ground_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>

#include "core/random.h"
#include "scene/world/tracer.h"
#include "terrain_kinds.h"

namespace skysweep::scene {
namespace {

constexpr Box2d kExtent{{-30, -30}, {130, 130}};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double gap(const Ground& ground, const Ray& ray, double t) {
  const Vec3d p = ray.origin + t * ray.direction;
  return p.z - ground.surface_m({p.x, p.y});
}

// First t in [from, to] where the ray is not above the surface, in steps of `step`.
std::optional<double> march(const Ground& ground, const Ray& ray, double from, double to, double step) {
  for (double t = from; t < to; t += step) {
    if (gap(ground, ray, t + step) > 0) continue;
    double above = t, below = t + step;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (above + below);
      (gap(ground, ray, middle) > 0 ? above : below) = middle;
    }
    return below;
  }
  return std::nullopt;
}

// How the tracer and the marcher agree on rays from 100 m above the area; `tilt` is the largest horizontal part of a
// direction that goes 1 down.
void expect_agreement(const std::string& name, const Terrain& terrain, double tilt, int rays, std::uint64_t seed) {
  const Ground ground(terrain, 5);
  const GroundTracer tracer(ground, kExtent);
  Random random(seed);
  double worst = 0;
  for (int i = 0; i < rays; ++i) {
    const double heading = random.uniform(0, 6.28), steep = random.uniform(0, tilt);
    const Vec3d direction = normalized({steep * std::cos(heading), steep * std::sin(heading), -1});
    // Aimed at a point of the surface, which something in front may hide.
    const Vec2d p{random.uniform(10, 90), random.uniform(10, 90)};
    const Vec3d target{p.x, p.y, ground.surface_m(p)};
    const Ray ray{target + ((100 - target.z) / direction.z) * direction, direction};
    bool active = true;
    std::optional<GroundTracer::Hit> hit;
    tracer.first_hits(&ray, &active, 1, kInfinity, &hit);
    ASSERT_TRUE(hit) << name;
    const double highest = ground.heights(kExtent).highest;
    const double from = std::max(0.0, (highest - 100) / direction.z);
    const std::optional<double> marched = march(ground, ray, from, hit->t + 1, 0.005);
    ASSERT_TRUE(marched) << name << ": ray " << i << " hit at " << hit->t << ", " << gap(ground, ray, hit->t)
                         << " above the surface";
    // The marcher may step over a crest that the ray just touches: then the tracer is before it, on the surface.
    if (hit->t < *marched - 1e-4) {
      EXPECT_NEAR(gap(ground, ray, hit->t), 0, 1e-8) << name << " ray " << i;
      EXPECT_LT(gap(ground, ray, hit->t + 0.002), 0.004) << name << " ray " << i;
      continue;
    }
    worst = std::max(worst, std::abs(hit->t - *marched));
  }
  EXPECT_LT(worst, 1e-4) << name;
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", worst);
  testing::Test::RecordProperty("worst_m_" + name, text);
}

TEST(GroundTracer, rays_meet_every_kind_of_ground_where_its_closed_form_is) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) expect_agreement(name, terrain, 0.9, 150, 11);
}

TEST(GroundTracer, rays_that_graze_meet_it_there_too) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) expect_agreement(name, terrain, 1.6, 60, 12);
}

TEST(GroundTracer, a_ray_five_millimetres_below_a_crest_does_not_slip_through) {
  // The crest lies up to 26 mm above a mesh through points of the ground.
  const Ground ground(shaped(SinusoidTerrain{120, {50, 50}}, 6, 25), 5);
  const GroundTracer tracer(ground, kExtent);
  const Vec2d across{std::sin(120 * std::numbers::pi / 180), std::cos(120 * std::numbers::pi / 180)};
  for (int i = 0; i < 200; ++i) {
    const Vec2d crest = Vec2d{50, 50} + 6.25 * across + (0.1 * i - 10) * Vec2d{-across.y, across.x};
    const Vec2d valley = crest - 12.5 * across;
    const Ray ray{{valley.x, valley.y, ground.at(crest).z - 0.005}, {across.x, across.y, 0}};
    const bool active = true;
    std::optional<GroundTracer::Hit> hit;
    tracer.first_hits(&ray, &active, 1, kInfinity, &hit);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, *march(ground, ray, 0, 13, 0.01), 1e-6);
  }
}

TEST(GroundTracer, a_vertical_ray_gives_the_height_itself) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) {
    const Ground ground(terrain, 5);
    const Tracer tracer(ground, {}, kExtent);
    Random random(4);
    for (int i = 0; i < 300; ++i) {
      const Vec2d p{random.uniform(0, 100), random.uniform(0, 100)};
      const Ray down{{p.x, p.y, 80}, {0, 0, -1}};
      SurfacePoint hit;
      tracer.first_hits(&down, 1, &hit);
      ASSERT_NEAR(hit.position.z, ground.surface_m(p), 1e-9) << name;
      const bool water = ground.water_level_m() && ground.at(p).z < *ground.water_level_m();
      ASSERT_EQ(hit.face, water ? Face::water : Face::ground) << name;
    }
  }
}

TEST(GroundTracer, a_point_in_the_sun_is_not_in_the_shadow_of_its_own_ground) {
  // A ray from a centimetre above the ground, along its normal, as shadows and views are decided.
  for (const auto& [name, terrain] : terrains_of_every_kind()) {
    const Ground ground(terrain, 5);
    const Tracer tracer(ground, {}, kExtent);
    Random random(6);
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec2d p{random.uniform(20, 80), random.uniform(20, 80)};
      const Ground::Sample here = ground.at(p);
      if (ground.surface_m(p) > here.z) continue;
      const Vec3d normal = normalized(Vec3d{-here.slope.x, -here.slope.y, 1});
      const Vec3d sun = normalized(Vec3d{0.5, -0.6, 0.7});
      if (dot(normal, sun) <= 0) continue;
      const Ray ray{Vec3d{p.x, p.y, here.z} + 0.01 * normal, sun};
      const bool active = true;
      bool blocked = false;
      tracer.blocked(&ray, &active, 1, true, &blocked);
      bool expected = false;
      for (double t = 0.002; t < 60 && !expected; t += 0.01) expected = gap(ground, ray, t) < 0;
      wrong += blocked != expected;
    }
    EXPECT_LE(wrong, 1) << name;
  }
}

TEST(GroundTracer, a_building_in_front_of_a_slope_is_met_first_and_behind_it_is_not_seen) {
  const Ground ground(shaped(RampTerrain{60, 10, 0, 90, {50, 50}}), 1);
  SolidBox box;
  box.center = {70, 50};
  box.half = {2, 2};
  box.z_low = 0;
  box.z_high = 14;
  const Solids solids{.boxes = {box}};
  const Tracer tracer(ground, solids, kExtent);
  const auto face = [&](Vec3d from, Vec3d direction) {
    const Ray ray{from, direction};
    SurfacePoint hit;
    tracer.first_hits(&ray, 1, &hit);
    return hit.face;
  };
  EXPECT_EQ(face({70, 50, 100}, {0, 0, -1}), Face::top);
  EXPECT_EQ(face({20, 50, 12}, {1, 0, 0}), Face::wall);   // over the slope's top
  EXPECT_EQ(face({20, 50, 5}, {1, 0, 0}), Face::ground);  // into it
}

TEST(GroundTracer, lakes_are_level_and_end_at_the_shore) {
  Terrain terrain = shaped(SinusoidTerrain{90, {0, 0}}, 4, 20);
  terrain.water_level_m = -0.5;
  const Ground ground(terrain, 1);
  const Tracer tracer(ground, {}, kExtent);
  int water = 0;
  for (double x = 0; x < 40; x += 0.1) {
    const Ray ray{{x - 5, 30, 50}, {0.1, 0, -1}};
    SurfacePoint hit;
    tracer.first_hits(&ray, 1, &hit);
    if (hit.face != Face::water) {
      EXPECT_GE(hit.position.z, -0.5 - 1e-9);
      continue;
    }
    ++water;
    EXPECT_EQ(hit.position.z, -0.5);
    EXPECT_EQ(hit.normal, (Vec3d{0, 0, 1}));
    EXPECT_LT(ground.at({hit.position.x, hit.position.y}).z, -0.5);
  }
  EXPECT_GT(water, 100);
}

}  // namespace
}  // namespace skysweep::scene
