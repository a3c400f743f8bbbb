// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/specular_water.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kWaveStream = 0xeffc20;
constexpr double kRefractiveIndex = 1.333;
constexpr double kWindiest_mps = 14;  // up to here Cox & Munk measured
constexpr double kLiftOff_m = 0.01;   // a ray from the water starts this far above it
// Where waves are seen at a flatter angle they hide each other, which the formula does not know.
constexpr double kLeastCosine = 0.1;
// The world gives level ground the same light until the sun is this low.
constexpr double kLowSun = 0.2;

Vec3d normal_of(Vec2d slope) { return normalized(Vec3d{-slope.x, -slope.y, 1}); }

// Where light that arrives at `to_camera` comes from. What would come from below has met the water twice.
Vec3d mirrored(Vec3d to_camera, Vec3d normal) {
  Vec3d out = 2 * dot(normal, to_camera) * normal - to_camera;
  out.z = std::abs(out.z);
  return out;
}

}  // namespace

std::vector<Dial> dials(SpecularWater& s) {
  return {{"wind_mps", &s.wind_mps, 0, kWindiest_mps, true}, {"wind_from_deg", &s.wind_from_deg, -360, 360}};
}

double water_reflectance(double cosine) {
  const double in_water = std::sqrt(1 - (1 - cosine * cosine) / (kRefractiveIndex * kRefractiveIndex));
  const double across = (cosine - kRefractiveIndex * in_water) / (cosine + kRefractiveIndex * in_water);
  const double along = (kRefractiveIndex * cosine - in_water) / (kRefractiveIndex * cosine + in_water);
  return 0.5 * (across * across + along * along);
}

double sun_glitter(Vec3d to_camera, Vec3d to_sun, Vec2d slope, double variance) {
  const Vec3d facet = normalized(to_camera + to_sun);  // the normal that mirrors one into the other
  if (!(facet.z > 0)) return 0;
  const Vec2d off = Vec2d{-facet.x / facet.z, -facet.y / facet.z} - slope;
  const double density_times_pi = std::exp(-dot(off, off) / variance) / variance;
  return water_reflectance(dot(facet, to_sun)) * density_times_pi /
         (4 * std::max(kLeastCosine, to_camera.z) * std::pow(facet.z, 4));
}

SpecularWaterEffect::SpecularWaterEffect(const SpecularWater& settings, const Scene& scene, const std::vector<Shot>&)
    : SurfaceEffect(EffectId::specular_water),
      waves_(settings.wind_mps, settings.wind_from_deg, scene.gsd_m(), mix64(scene.seed) ^ kWaveStream),
      shadows_(scene.light.shadows) {
  if (!scene.terrain.water_level_m)
    throw usage_error(settings.named_at + " needs water: give [terrain] a water_level_m, or leave the table out");
}

void SpecularWaterEffect::see_sun(const World& world, const Moment& moment, const SurfacePoint* water, int count,
                                  float* sun) const {
  std::array<Ray, Tracer::kBatch> to_sun;
  std::array<bool, Tracer::kBatch> active{}, in_shadow{};
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    to_sun[at] = {water[i].position + Vec3d{0, 0, kLiftOff_m}, moment.towards_sun};
    active[at] = true;
  }
  if (shadows_) world.tracer().blocked(to_sun.data(), active.data(), count, true, in_shadow.data());
  if (shadows_ && moment.traffic) moment.traffic->blocked(to_sun.data(), active.data(), count, in_shadow.data());
  for (int i = 0; i < count; ++i) sun[i] = in_shadow[static_cast<std::size_t>(i)] ? 0.f : 1.f;
  if (moment.clouds) moment.clouds->dim(water, count, moment.towards_sun, sun);
}

void SpecularWaterEffect::shine(const Shot& shot, const World& world, const Moment& moment, const Ray* rays,
                                const SurfacePoint* hits, int count, LinearRgb* light) const {
  std::array<int, Tracer::kBatch> which;
  std::array<SurfacePoint, Tracer::kBatch> water, in_mirror;
  std::array<Vec2d, Tracer::kBatch> slope;
  std::array<Vec3d, Tracer::kBatch> to_camera;
  std::array<Ray, Tracer::kBatch> from_mirror;
  int found = 0;
  for (int i = 0; i < count; ++i) {
    if (hits[i].face != Face::water) continue;
    const auto at = static_cast<std::size_t>(found++);
    which[at] = i;
    water[at] = hits[i];
    to_camera[at] = -normalized(rays[i].direction);
    slope[at] = waves_.slope({hits[i].position.x, hits[i].position.y}, shot.time_s);
    from_mirror[at] = {hits[i].position + Vec3d{0, 0, kLiftOff_m}, mirrored(to_camera[at], normal_of(slope[at]))};
  }
  if (found == 0) return;
  std::array<LinearRgb, Tracer::kBatch> mirror_image;
  world.look(from_mirror.data(), found, in_mirror.data(), mirror_image.data(), moment);
  std::array<float, Tracer::kBatch> sun;
  see_sun(world, moment, water.data(), found, sun.data());
  const LinearRgb facing_sun = static_cast<float>(1 / std::max(kLowSun, moment.towards_sun.z)) * moment.sun;
  for (int i = 0; i < found; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double cosine = std::clamp(dot(normal_of(slope[at]), to_camera[at]), 0., 1.);
    const auto reflected = static_cast<float>(water_reflectance(cosine));
    const LinearRgb image = in_mirror[at].face == Face::none ? moment.sky : mirror_image[at];
    const auto glitter =
        static_cast<float>(sun_glitter(to_camera[at], moment.towards_sun, slope[at], waves_.fine_variance()));
    LinearRgb& out = light[which[at]];
    out = (1 - reflected) * out + reflected * image + (sun[at] * glitter) * facing_sun;
  }
}

}  // namespace skysweep::scene
