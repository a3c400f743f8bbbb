// SPDX-License-Identifier: Apache-2.0
// What a water surface throws back towards the camera: the mirror image of sky and shore, and the glitter of the sun.
// Both depend on where the camera is, so that a place on the water looks different in each photograph. The truth has
// neither: an orthophoto has no place from which it is seen.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/effects/water_waves.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(SpecularWater& settings);

// Share of unpolarised light that a level water surface throws back, `cosine` being that of the angle of incidence, 0
// to 1 (Fresnel; refractive index 1.333).
double water_reflectance(double cosine);

// Light of the sun's glitter, over that of a white surface which faces the sun: pi x reflectance x p / (4 cos v cos^4
// b), p the density of the slope that mirrors the sun towards the camera, b its inclination and v the camera's zenith
// angle (Cox & Munk 1954). Slopes are distributed normally about `slope`, with mean square deviation `variance`. Unit
// vectors.
double sun_glitter(Vec3d to_camera, Vec3d to_sun, Vec2d slope, double variance);

class SpecularWaterEffect final : public SurfaceEffect {
 public:
  // Throws Error(usage) if the scene has no water.
  SpecularWaterEffect(const SpecularWater& settings, const Scene& scene, const std::vector<Shot>& shots);
  void shine(const Shot& shot, const World& world, const Moment& moment, const Ray* rays, const SurfacePoint* hits,
             int count, LinearRgb* light) const override;

 private:
  // The part of the sun's light that reaches each of `count` places on the water.
  void see_sun(const World& world, const Moment& moment, const SurfacePoint* water, int count, float* sun) const;

  WaterWaves waves_;
  bool shadows_;
};

}  // namespace skysweep::scene
