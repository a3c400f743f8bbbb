// SPDX-License-Identifier: Apache-2.0
// Cars that drive along the streets of a town: each photograph finds them elsewhere. They are in no truth.
#pragma once

#include "core/array2d.h"
#include "core/box.h"
#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"
#include "scene/world/town.h"

namespace skysweep::scene {

std::vector<Dial> dials(MovingCars& settings);

struct MovingCar {
  Vec2d center;
  Vec2d axis_u;  // horizontal unit vector along the car
  Vec2d half;
  double z_low = 0, z_high = 0;
  LinearRgb paint;
};

// Cars at one moment, found quickly along a ray: closed form, in double.
class Traffic final : public PassingSolids {
 public:
  // `meter` must outlive the object.
  Traffic(std::vector<MovingCar> cars, const Meter& meter);
  void first_hits(const Ray* rays, int count, SurfacePoint* hits, LinearRgb* own, bool* passing) const override;
  void blocked(const Ray* rays, const bool* active, int count, bool* out) const override;

 private:
  // The first car along the ray before `farthest` (in lengths of its direction), or null.
  const MovingCar* nearest(const Ray& ray, double& farthest, Vec3d& normal) const;

  std::vector<MovingCar> cars_;
  const Meter& meter_;
  Box2d extent_;
  double z_low_ = 0, z_high_ = 0;
  Array2d<std::vector<int>> cells_;  // cars that reach into each
};

class MovingCarsEffect final : public LightEffect {
 public:
  // Throws Error(usage) if the scene has no town, or streets too narrow to pass parked cars.
  MovingCarsEffect(const MovingCars& settings, const Scene& scene, const std::vector<Shot>& shots);
  void change(const Shot& shot, const World& world, Moment& moment) const override;

  // All cars on `extent` at a time; heights from `world`.
  std::vector<MovingCar> cars_at(double time_s, const Box2d& extent, const World& world) const;

 private:
  MovingCars settings_;
  const Scene& scene_;
  std::optional<StreetPlan> streets_;
  std::uint32_t seed_;
};

}  // namespace skysweep::scene
