// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/sun_movement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "scene/effects/pose_error.h"

namespace skysweep::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

std::vector<Dial> dials(SunMovement& s) {
  return {{"hours", &s.hours, kAboveZero, 24, true}, {"latitude_deg", &s.latitude_deg, -90, 90}};
}

Vec3d sun_after(Vec3d towards_sun, double hours, double latitude_deg) {
  const Vec3d pole{0, std::cos(latitude_deg * kDegree), std::sin(latitude_deg * kDegree)};
  return rotation_about(-15 * kDegree * hours * pole) * towards_sun;
}

SunMovementEffect::SunMovementEffect(const SunMovement& settings, const Scene& scene, const std::vector<Shot>& shots)
    : LightEffect(EffectId::sun_movement), settings_(settings), duration_s_(shots.back().time_s) {
  const double azimuth = scene.light.sun_azimuth_deg * kDegree, elevation = scene.light.sun_elevation_deg * kDegree;
  const Vec3d middle{std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                     std::sin(elevation)};
  for (const double hours : {-0.5 * settings.hours, 0.5 * settings.hours})
    if (sun_after(middle, hours, settings.latitude_deg).z < std::sin(2 * kDegree))
      throw usage_error(settings.named_at +
                        " takes the sun below 2 degrees: fewer hours, or a higher light.sun_elevation_deg");
}

double SunMovementEffect::hours_at(double time_s) const {
  return duration_s_ > 0 ? (time_s / duration_s_ - 0.5) * settings_.hours : 0;
}

void SunMovementEffect::change(const Shot& shot, const World&, Moment& moment) const {
  moment.towards_sun = sun_after(moment.towards_sun, hours_at(shot.time_s), settings_.latitude_deg);
}

}  // namespace skysweep::scene
