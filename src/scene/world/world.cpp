// SPDX-License-Identifier: Apache-2.0
#include "scene/world/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skysweep::scene {
namespace {

// Sun and sky of a clear day; on level ground they add up to about one.
constexpr LinearRgb kSun{0.80f, 0.77f, 0.71f};
constexpr LinearRgb kSky{0.19f, 0.23f, 0.30f};
constexpr LinearRgb kHaze{0.60f, 0.68f, 0.78f};  // where a ray meets nothing

// A shadow or sight ray starts this far from its surface: more than the mesh of the ground deviates from the ground.
constexpr double kLiftOff = 0.01;

Vec3d direction_to_sun(const Light& light) {
  const double azimuth = light.sun_azimuth_deg * std::numbers::pi / 180;
  const double elevation = light.sun_elevation_deg * std::numbers::pi / 180;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

std::optional<StreetPlan> plan_streets(const Scene& scene) {
  if (!scene.town) return std::nullopt;
  return StreetPlan(*scene.town, 0.5 * scene.area_m);
}

// Of surfaces without texture.
LinearRgb plain_reflectance(Face face) {
  switch (face) {
    case Face::ground: return {0.22f, 0.22f, 0.22f};
    case Face::top: return {0.34f, 0.34f, 0.34f};
    case Face::wall: return {0.45f, 0.45f, 0.45f};
    case Face::leaf: return {0.12f, 0.12f, 0.12f};
    case Face::water: return {0.06f, 0.06f, 0.06f};
    case Face::none: break;
  }
  return {};
}

// Beyond what is seen, as far as shadows and blocks reach into it.
Box2d with_surroundings(const Scene& scene, const Box2d& visible) {
  double margin = scene.town ? std::max(scene.town->block_m, scene.town->block_depth_m) + scene.town->street_m : 1.0;
  if (scene.things.forest) margin = std::max(margin, scene.things.forest->max_height_m);
  return {{visible.min.x - margin, visible.min.y - margin}, {visible.max.x + margin, visible.max.y + margin}};
}

}  // namespace

World::World(const Scene& scene, const Box2d& visible)
    : ground_(scene),
      streets_(plan_streets(scene)),
      solids_(build_solids(scene, ground_, streets_, with_surroundings(scene, visible))),
      tracer_(ground_, solids_, with_surroundings(scene, visible)),
      materials_(scene, ground_, streets_, solids_),
      moment_{direction_to_sun(scene.light), kSun, kSky, nullptr, nullptr},
      textured_(scene.texture.ground != GroundTexture::none),
      shadows_(scene.light.shadows),
      lowest_m_(ground_.heights(with_surroundings(scene, visible)).lowest),
      highest_m_(ground_.heights(with_surroundings(scene, visible)).highest) {
  highest_m_ = std::max(highest_m_, solids_.highest_m());
}

void World::look(const Ray* rays, int count, SurfacePoint* hits, LinearRgb* light, const Moment& moment) const {
  tracer_.first_hits(rays, count, hits);
  LinearRgb passing_own[Tracer::kBatch];
  bool passing[Tracer::kBatch] = {};
  if (moment.traffic) moment.traffic->first_hits(rays, count, hits, passing_own, passing);
  const Vec3d towards_sun = moment.towards_sun;
  bool faces_sun[Tracer::kBatch], in_shadow[Tracer::kBatch] = {};
  for (int i = 0; i < count; ++i) faces_sun[i] = hits[i].face != Face::none && dot(hits[i].normal, towards_sun) > 0;
  if (shadows_) {
    Ray to_sun[Tracer::kBatch];
    for (int i = 0; i < count; ++i) to_sun[i] = {hits[i].position + kLiftOff * hits[i].normal, towards_sun};
    tracer_.blocked(to_sun, faces_sun, count, true, in_shadow);
    if (moment.traffic) moment.traffic->blocked(to_sun, faces_sun, count, in_shadow);
  }
  float sun[Tracer::kBatch];
  const double per_level = 1 / std::max(0.2, towards_sun.z);
  for (int i = 0; i < count; ++i)
    sun[i] = static_cast<float>(faces_sun[i] && !in_shadow[i] ? per_level * dot(hits[i].normal, towards_sun) : 0.0);
  if (moment.clouds) moment.clouds->dim(hits, count, towards_sun, sun);
  for (int i = 0; i < count; ++i) {
    if (hits[i].face == Face::none) {
      light[i] = kHaze;
      continue;
    }
    const double sky = 0.5 + 0.5 * hits[i].normal.z;
    const LinearRgb received = sun[i] * moment.sun + static_cast<float>(sky) * moment.sky;
    const LinearRgb own = passing[i]  ? passing_own[i]
                          : textured_ ? materials_.reflectance(hits[i])
                                      : plain_reflectance(hits[i].face);
    light[i] = {own.r * received.r, own.g * received.g, own.b * received.b};
  }
}

}  // namespace skysweep::scene
