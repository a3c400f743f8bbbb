// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/moving_cars.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "camera/camera.h"
#include "core/error.h"
#include "core/random.h"
#include "scene/world/noise.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kTrafficStream = 0xeffca5;
constexpr double kCell_m = 8;       // of the grid in which cars are looked up
constexpr double kSpace_m = 7;      // the least a car takes of its lane
constexpr double kAround_m = 30;    // cars this far outside a photograph throw shadows into it
constexpr double kPassable_m = 10;  // width of a street with parked cars on both sides and room between them
constexpr std::array<LinearRgb, 5> kPaints = {{{0.62f, 0.62f, 0.60f},
                                               {0.03f, 0.03f, 0.035f},
                                               {0.32f, 0.33f, 0.35f},
                                               {0.36f, 0.04f, 0.03f},
                                               {0.05f, 0.10f, 0.30f}}};
constexpr LinearRgb kGlass{0.05f, 0.06f, 0.075f};

double unit(std::uint32_t hash) { return (hash >> 8) * 0x1p-24; }

// Narrows [from, to] to where origin + t direction lies within +-half; false if nothing is left.
bool clip(double origin, double direction, double half, double& from, double& to, bool& entered) {
  entered = false;
  if (direction == 0) return std::abs(origin) <= half;
  double near = (-half - origin) / direction, far = (half - origin) / direction;
  if (near > far) std::swap(near, far);
  if (near > from) from = near, entered = true;
  to = std::min(to, far);
  return from <= to;
}

// Where the ray enters the car before `farthest`, if it does: sets `farthest` and the normal there.
bool enter(const MovingCar& car, const Ray& ray, double& farthest, Vec3d& normal) {
  const Vec2d axis_v{-car.axis_u.y, car.axis_u.x};
  const Vec2d start = Vec2d{ray.origin.x, ray.origin.y} - car.center, way{ray.direction.x, ray.direction.y};
  const double u = dot(way, car.axis_u), v = dot(way, axis_v), w = ray.direction.z;
  const double middle = 0.5 * (car.z_low + car.z_high), half_height = 0.5 * (car.z_high - car.z_low);
  double from = 0, to = farthest;
  bool entered = false;
  Vec3d side;
  if (!clip(dot(start, car.axis_u), u, car.half.x, from, to, entered)) return false;
  if (entered) side = (u > 0 ? -1.0 : 1.0) * Vec3d{car.axis_u.x, car.axis_u.y, 0};
  if (!clip(dot(start, axis_v), v, car.half.y, from, to, entered)) return false;
  if (entered) side = (v > 0 ? -1.0 : 1.0) * Vec3d{axis_v.x, axis_v.y, 0};
  if (!clip(ray.origin.z - middle, w, half_height, from, to, entered)) return false;
  if (entered) side = {0, 0, w > 0 ? -1.0 : 1.0};
  if (!(from > 0)) return false;
  farthest = from;
  normal = side;
  return true;
}

LinearRgb paint_at(const MovingCar& car, Vec3d position, Vec3d normal) {
  const double along = dot(Vec2d{position.x, position.y} - car.center, car.axis_u);
  const bool windows =
      normal.z > 0.5 ? std::abs(std::abs(along + 0.2) - 1.0) < 0.3 : position.z > 0.5 * (car.z_low + car.z_high) + 0.2;
  return windows ? kGlass : car.paint;
}

}  // namespace

std::vector<Dial> dials(MovingCars& s) {
  return {{"per_100m", &s.per_100m, kAboveZero, 100 / kSpace_m, true}, {"speed_mps", &s.speed_mps, kAboveZero, 100}};
}

Traffic::Traffic(std::vector<MovingCar> cars, const Meter& meter) : cars_(std::move(cars)), meter_(meter) {
  if (cars_.empty()) return;
  z_low_ = cars_[0].z_low;
  z_high_ = cars_[0].z_high;
  const auto reach = [](const MovingCar& car) { return norm(car.half); };
  for (const MovingCar& car : cars_) {
    extent_.extend(car.center - Vec2d{reach(car), reach(car)});
    extent_.extend(car.center + Vec2d{reach(car), reach(car)});
    z_low_ = std::min(z_low_, car.z_low);
    z_high_ = std::max(z_high_, car.z_high);
  }
  cells_ = Array2d<std::vector<int>>(static_cast<int>(extent_.width() / kCell_m) + 1,
                                     static_cast<int>(extent_.height() / kCell_m) + 1);
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    const Vec2d low = (1 / kCell_m) * (cars_[i].center - Vec2d{reach(cars_[i]), reach(cars_[i])} - extent_.min);
    const Vec2d high = (1 / kCell_m) * (cars_[i].center + Vec2d{reach(cars_[i]), reach(cars_[i])} - extent_.min);
    for (int y = std::max(0, floor_int(low.y)); y <= std::min(cells_.height() - 1, floor_int(high.y)); ++y)
      for (int x = std::max(0, floor_int(low.x)); x <= std::min(cells_.width() - 1, floor_int(high.x)); ++x)
        cells_(x, y).push_back(static_cast<int>(i));
  }
}

const MovingCar* Traffic::nearest(const Ray& ray, double& farthest, Vec3d& normal) const {
  if (cars_.empty()) return nullptr;
  // The part of the way between the heights of the cars, and the cells below it.
  double from = 0, to = farthest;
  bool entered;
  if (!clip(ray.origin.z - 0.5 * (z_low_ + z_high_), ray.direction.z, 0.5 * (z_high_ - z_low_), from, to, entered))
    return nullptr;
  const auto cell_of = [](double v, double low, int count) {
    return static_cast<int>(std::clamp((v - low) / kCell_m, 0.0, count - 1.0));
  };
  constexpr double kFarthest = 1e6;  // an endless way is cut off outside every scene
  to = std::min(to, kFarthest / norm(ray.direction));
  const Vec3d a = ray.origin + from * ray.direction, b = ray.origin + to * ray.direction;
  if (std::max(a.x, b.x) < extent_.min.x || std::min(a.x, b.x) > extent_.max.x || std::max(a.y, b.y) < extent_.min.y ||
      std::min(a.y, b.y) > extent_.max.y)
    return nullptr;
  const MovingCar* found = nullptr;
  for (int y = cell_of(std::min(a.y, b.y), extent_.min.y, cells_.height());
       y <= cell_of(std::max(a.y, b.y), extent_.min.y, cells_.height()); ++y)
    for (int x = cell_of(std::min(a.x, b.x), extent_.min.x, cells_.width());
         x <= cell_of(std::max(a.x, b.x), extent_.min.x, cells_.width()); ++x)
      for (const int car : cells_(x, y))
        if (enter(cars_[static_cast<std::size_t>(car)], ray, farthest, normal))
          found = &cars_[static_cast<std::size_t>(car)];
  return found;
}

void Traffic::first_hits(const Ray* rays, int count, SurfacePoint* hits, LinearRgb* own, bool* passing) const {
  const Stopwatch stopwatch(meter_, 0);
  for (int i = 0; i < count; ++i) {
    const Ray& ray = rays[i];
    double farthest = hits[i].face == Face::none
                          ? kNoLimit
                          : dot(hits[i].position - ray.origin, ray.direction) / dot(ray.direction, ray.direction);
    Vec3d normal;
    const MovingCar* car = nearest(ray, farthest, normal);
    if (!car) continue;
    hits[i] = {};
    hits[i].face = normal.z > 0.5 ? Face::top : Face::wall;
    hits[i].position = ray.origin + farthest * ray.direction;
    hits[i].normal = normal;
    own[i] = paint_at(*car, hits[i].position, normal);
    passing[i] = true;
  }
}

void Traffic::blocked(const Ray* rays, const bool* active, int count, bool* out) const {
  const Stopwatch stopwatch(meter_, 0);
  for (int i = 0; i < count; ++i) {
    if (!active[i] || out[i]) continue;
    double farthest = kNoLimit;
    Vec3d normal;
    out[i] = nearest(rays[i], farthest, normal) != nullptr;
  }
}

MovingCarsEffect::MovingCarsEffect(const MovingCars& settings, const Scene& scene, const std::vector<Shot>&)
    : LightEffect(EffectId::moving_cars),
      settings_(settings),
      scene_(scene),
      seed_(static_cast<std::uint32_t>(mix64(mix64(scene.seed) ^ kTrafficStream))) {
  if (!scene.town)
    throw usage_error(settings.named_at + " needs streets to drive on: add the table [town], or leave the table out");
  if (scene.town->cars_per_100m > 0 && scene.town->street_m < kPassable_m)
    throw usage_error(settings.named_at +
                      " needs streets wide enough to pass parked cars: set town.street_m to 10 or more, or "
                      "town.cars_per_100m to 0");
  streets_.emplace(*scene.town, 0.5 * scene.area_m);
}

// Streets that run along one side of the blocks are one-way, to and fro in turn. All cars of a street are equally fast,
// so that none meets another; each has a stretch of road of its own, somewhere in which it drives.
std::vector<MovingCar> MovingCarsEffect::cars_at(double time_s, const Box2d& extent, const World& world) const {
  Box2d in_plan;
  for (const Vec2d corner : {extent.min, extent.max, Vec2d{extent.min.x, extent.max.y}, {extent.max.x, extent.min.y}})
    in_plan.extend(streets_->to_plan(corner));
  const double pitch = streets_->pitch_m(), stretch = 100 / settings_.per_100m;
  const Vec2d along{-streets_->axis_u().y, streets_->axis_u().x};
  std::vector<MovingCar> cars;
  for (int street = floor_int(in_plan.min.x / pitch - 0.5); street <= floor_int(in_plan.max.x / pitch + 0.5);
       ++street) {
    const double forward = street & 1 ? -1 : 1;
    const double speed = settings_.speed_mps * (0.5 + 0.5 * unit(lattice_hash(street, 0, seed_ + 1)));
    const double moved = forward * speed * time_s;
    for (int i = floor_int((in_plan.min.y - moved) / stretch) - 1; i <= floor_int((in_plan.max.y - moved) / stretch);
         ++i) {
      const std::uint32_t looks = lattice_hash(street, i, seed_);
      const double within = unit(lattice_hash(street, i, seed_ + 2)) * (stretch - kSpace_m);
      const Vec2d q{(street + 0.5) * pitch, i * stretch + within + moved};
      if (!in_plan.contains(q)) continue;
      MovingCar car;
      car.center = streets_->from_plan(q);
      car.axis_u = forward * along;
      car.half = {1.9 + 0.5 * unit(looks), 0.88};
      const double ground = world.ground_m(car.center);
      car.z_low = ground - 0.3;
      car.z_high = ground + 1.4 + 0.4 * unit(lattice_hash(street, i, seed_ + 3));
      car.paint = kPaints[looks % kPaints.size()];
      cars.push_back(car);
    }
  }
  return cars;
}

void MovingCarsEffect::change(const Shot& shot, const World& world, Moment& moment) const {
  constexpr double kFarthest = 6;  // altitudes: ground beyond is sky
  Box2d seen;
  for (const Vec2d p : camera::footprint({scene_.camera, shot.pose}, world.lowest_m(), world.highest_m(),
                                         kFarthest * scene_.altitude_m()))
    seen.extend(p);
  if (seen.empty()) return;
  const Box2d around{seen.min - Vec2d{kAround_m, kAround_m}, seen.max + Vec2d{kAround_m, kAround_m}};
  moment.traffic = std::make_shared<Traffic>(cars_at(shot.time_s, around, world), meter());
}

}  // namespace skysweep::scene
