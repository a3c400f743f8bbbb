// SPDX-License-Identifier: Apache-2.0
#include "scene/world/ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "scene/world/terrain/dem.h"
#include "scene/world/terrain/direction.h"
#include "scene/world/terrain/fractal.h"
#include "scene/world/terrain/island.h"
#include "scene/world/terrain/plane.h"
#include "scene/world/terrain/profile.h"
#include "scene/world/terrain/quarry.h"

namespace skysweep::scene {
namespace {

using Surface = std::shared_ptr<const TerrainSurface>;

ProfileSurface ramp(const RampTerrain& shape) {
  const double half = 0.5 * shape.length_m, rise = half * std::tan(radians(shape.slope_deg));
  return {Profile({{-half, -rise}, {half, rise}}, shape.break_width_m), shape.azimuth_deg, shape.center};
}

ProfileSurface step(const StepTerrain& shape) {
  const double half = 0.5 * shape.height_m / std::tan(radians(shape.face_deg));
  return {Profile({{-half, -0.5 * shape.height_m}, {half, 0.5 * shape.height_m}}, 0), shape.azimuth_deg, shape.center};
}

ProfileSurface terraces(const TerracesTerrain& shape) {
  const double face_m = shape.height_m / std::tan(radians(shape.face_deg));
  std::vector<Profile::Corner> corners;
  for (int i = 0; i < shape.steps; ++i) {
    const double foot = i * (face_m + shape.bench_m);
    corners.push_back({foot, i * shape.height_m});
    corners.push_back({foot + face_m, (i + 1) * shape.height_m});
  }
  return {Profile(corners, 0), shape.azimuth_deg, shape.center};
}

template <typename S>
Surface share(S surface) {
  return std::make_shared<const S>(std::move(surface));
}

// The shape that a terrain names; none for plain rolling ground. `scene` may be null for those that come from no file.
Surface build_shape(const Terrain& terrain, std::uint64_t seed, const Scene* scene) {
  struct Builder {
    const Terrain& terrain;
    std::uint64_t seed;
    const Scene* scene;
    Surface operator()(const std::monostate&) const { return nullptr; }
    Surface operator()(const PlaneTerrain& s) const { return share(TiltedPlane(s)); }
    Surface operator()(const RampTerrain& s) const { return share(ramp(s)); }
    Surface operator()(const StepTerrain& s) const { return share(step(s)); }
    Surface operator()(const TerracesTerrain& s) const { return share(terraces(s)); }
    Surface operator()(const SinusoidTerrain& s) const {
      return share(straight_waves(s, terrain.relief_m, terrain.wavelength_m));
    }
    Surface operator()(const FractalTerrain& s) const {
      return share(Fractal(s, terrain.relief_m, terrain.wavelength_m, seed));
    }
    Surface operator()(const QuarryTerrain& s) const { return share(Quarry(s)); }
    Surface operator()(const IslandTerrain& s) const { return share(build_island(s, seed)); }
    Surface operator()(const DemTerrain& s) const {
      SKY_CHECK(scene != nullptr);
      return share(read_dem(s, *scene));
    }
  };
  return std::visit(Builder{terrain, seed, scene}, terrain.shape);
}

bool takes_relief_itself(const Terrain& terrain) {
  return std::holds_alternative<SinusoidTerrain>(terrain.shape) ||
         std::holds_alternative<FractalTerrain>(terrain.shape);
}

HeightGrid build_modification(const TerrainModification& change) {
  Array2d<double> heights(change.columns, change.rows);
  for (int row = 0; row < change.rows; ++row)
    for (int column = 0; column < change.columns; ++column)
      heights(column, change.rows - 1 - row) =
          change.heights_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(change.columns) +
                           static_cast<std::size_t>(column)];
  const Vec2d spacing{change.size_m.x / (change.columns - 1), change.size_m.y / (change.rows - 1)};
  return {heights, change.center - 0.5 * change.size_m, spacing, HeightGrid::Beyond::zero};
}

// The box in (u, v) around one in (x, y), where u runs along `axis_u`; with the axis mirrored, the way back.
Box2d turned(const Box2d& box, Vec2d axis_u) {
  Box2d out;
  for (const Vec2d corner : {box.min, box.max, Vec2d{box.min.x, box.max.y}, Vec2d{box.max.x, box.min.y}})
    out.extend({dot(corner, axis_u), cross(axis_u, corner)});
  return out;
}

// Whether they have more than a border in common.
bool overlap(const Box2d& a, const Box2d& b) {
  constexpr double kTouch_m = 1e-9;
  return a.min.x < b.max.x - kTouch_m && b.min.x < a.max.x - kTouch_m && a.min.y < b.max.y - kTouch_m &&
         b.min.y < a.max.y - kTouch_m;
}

Ground::Sample sum(const Ground::Sample& a, const Ground::Sample& b) { return {a.z + b.z, a.slope + b.slope}; }

}  // namespace

Ground::Ground(const Scene& scene) : Ground(scene.terrain, scene.seed, &scene) {}
Ground::Ground(const Terrain& terrain, std::uint64_t seed) : Ground(terrain, seed, nullptr) {}

Ground::Ground(const Terrain& terrain, std::uint64_t seed, const Scene* scene)
    : rolling_(rolling_waves(terrain, seed)),
      rolls_(terrain.relief_m != 0 && !takes_relief_itself(terrain)),
      rolling_reach_m_(rolls_ ? 0.5 * terrain.relief_m : 0),
      shape_(build_shape(terrain, seed, scene)),
      water_level_m_(terrain.water_level_m) {
  if (shape_) mesh_axis_u_ = shape_->mesh_plan().axis_u;
  for (const TerrainModification& change : terrain.modifications) {
    HeightGrid grid = build_modification(change);
    const Box2d uv = turned(grid.extent(), mesh_axis_u_);
    modifications_.push_back({std::move(grid), uv});
  }
}

Ground::Sample Ground::at(Vec2d p) const {
  Sample out;
  if (rolls_) out = rolling_.at(p);
  if (shape_) out = sum(out, shape_->at(p));
  for (const Change& change : modifications_)
    if (change.grid.extent().contains(p)) out = sum(out, change.grid.at(p));
  return out;
}

double Ground::surface_m(Vec2d p) const {
  const double ground = at(p).z;
  return water_level_m_ ? std::max(ground, *water_level_m_) : ground;
}

HeightRange Ground::heights(const Box2d& box) const {
  HeightRange out{-rolling_reach_m_, rolling_reach_m_};
  const auto add = [&](const HeightRange& range) { out = {out.lowest + range.lowest, out.highest + range.highest}; };
  if (shape_) add(shape_->heights(box));
  for (const Change& change : modifications_)
    if (change.grid.extent().intersects(box)) {
      const HeightRange range = change.grid.heights(box);  // or none, beside it
      add({std::min(0.0, range.lowest), std::max(0.0, range.highest)});
    }
  if (water_level_m_) out = {std::max(out.lowest, *water_level_m_), std::max(out.highest, *water_level_m_)};
  return out;
}

MeshPlan Ground::mesh_plan() const {
  MeshPlan plan;
  if (shape_) plan = shape_->mesh_plan();
  if (rolls_) plan.spacing_m = std::min(plan.spacing_m, rolling_.mesh_plan().spacing_m);
  return plan;
}

double Ground::curvature(const Box2d& box) const {
  double out = 0;
  if (shape_) out += shape_->curvature(box);
  if (rolls_) out += rolling_.curvature(box);
  for (const Change& change : modifications_)
    if (overlap(change.uv, box)) out += change.grid.curvature(turned(box, {mesh_axis_u_.x, -mesh_axis_u_.y}));
  return out;
}

}  // namespace skysweep::scene
