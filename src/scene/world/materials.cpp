// SPDX-License-Identifier: Apache-2.0
#include "scene/world/materials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

// Detail of a material: strength of value noise at 1, 2, 4 and 16 times the finest size, relative to the colour.
using Spectrum = std::array<float, 4>;
constexpr Spectrum kAsphalt = {0.36f, 0.34f, 0.28f, 0.14f};
constexpr Spectrum kPaving = {0.28f, 0.26f, 0.20f, 0.10f};
constexpr Spectrum kLawn = {0.34f, 0.36f, 0.34f, 0.22f};
constexpr Spectrum kGravel = {0.36f, 0.36f, 0.26f, 0.10f};
constexpr Spectrum kTiles = {0.26f, 0.26f, 0.22f, 0.10f};
constexpr Spectrum kPlaster = {0.14f, 0.14f, 0.14f, 0.10f};
constexpr Spectrum kPaint = {0.04f, 0.04f, 0.05f, 0.04f};

float mottle(const Spectrum& spectrum, Vec2d in_finest, std::uint32_t seed) {
  constexpr std::array<double, 4> kScale = {1, 1. / 2, 1. / 4, 1. / 16};
  float sum = 0;
  for (std::size_t i = 0; i < spectrum.size(); ++i)
    sum += spectrum[i] * value_noise(kScale[i] * in_finest.x, kScale[i] * in_finest.y,
                                     seed + 0x51ed27u * static_cast<std::uint32_t>(i));
  return sum;
}

LinearRgb blend(LinearRgb a, LinearRgb b, float t) { return (1 - t) * a + t * b; }

// Smooth 0 to 1 as v goes from low to high.
float ramp(float v, float low, float high) { return std::clamp((v - low) / (high - low), 0.f, 1.f); }

float unit(std::uint32_t hash) { return static_cast<float>(hash >> 8) * 0x1p-24f; }

template <std::size_t N>
LinearRgb pick(const std::array<LinearRgb, N>& colors, std::uint32_t seed) {
  return colors[mix64(seed) % N];
}

constexpr std::array<LinearRgb, 5> kTileColors = {{{0.32f, 0.13f, 0.075f},
                                                   {0.24f, 0.11f, 0.07f},
                                                   {0.13f, 0.12f, 0.125f},
                                                   {0.36f, 0.18f, 0.10f},
                                                   {0.20f, 0.15f, 0.12f}}};
constexpr std::array<LinearRgb, 4> kFlatRoofColors = {
    {{0.30f, 0.29f, 0.27f}, {0.21f, 0.21f, 0.22f}, {0.38f, 0.36f, 0.33f}, {0.26f, 0.25f, 0.21f}}};
constexpr std::array<LinearRgb, 5> kWallColors = {{{0.55f, 0.50f, 0.40f},
                                                   {0.48f, 0.36f, 0.25f},
                                                   {0.58f, 0.57f, 0.54f},
                                                   {0.36f, 0.18f, 0.13f},
                                                   {0.45f, 0.44f, 0.38f}}};
constexpr std::array<LinearRgb, 6> kCarColors = {{{0.60f, 0.60f, 0.60f},
                                                  {0.03f, 0.03f, 0.035f},
                                                  {0.30f, 0.31f, 0.33f},
                                                  {0.35f, 0.03f, 0.03f},
                                                  {0.04f, 0.09f, 0.28f},
                                                  {0.14f, 0.14f, 0.15f}}};
constexpr LinearRgb kAsphaltColor{0.115f, 0.115f, 0.12f}, kPavingColor{0.29f, 0.275f, 0.25f},
    kMarkingColor{0.65f, 0.65f, 0.62f}, kGravelColor{0.34f, 0.30f, 0.235f}, kSoilColor{0.23f, 0.165f, 0.10f},
    kDryGrassColor{0.235f, 0.22f, 0.095f}, kGrassColor{0.095f, 0.165f, 0.045f}, kShrubColor{0.045f, 0.085f, 0.025f},
    kGlassColor{0.05f, 0.06f, 0.075f};

}  // namespace

Materials::Materials(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets,
                     const Solids& solids)
    : streets_(streets),
      solids_(solids),
      seed_(static_cast<std::uint32_t>(mix64(scene.seed ^ 0x3a7e))),
      contrast_(static_cast<float>(scene.texture.contrast)),
      per_finest_(1 / scene.finest_detail_m()),
      cover_(scene, ground) {}

LinearRgb Materials::reflectance(const SurfacePoint& point) const {
  if (point.face == Face::water) return cover_.water(point.position);
  if (point.face == Face::ground) {
    const Vec2d p{point.position.x, point.position.y};
    if (cover_.replaces()) return cover_.replacement(p);
    return cover_.bares() ? cover_.bared(ground(p), point.position, point.normal) : ground(p);
  }
  if (point.face == Face::leaf) return leaf(point);
  if (point.facet >= 0) return facet(point);
  const SolidBox& box = solids_.boxes[static_cast<std::size_t>(point.box)];
  if (point.face == Face::wall) return wall(box, point);
  return top(box, box.local({point.position.x, point.position.y}));
}

LinearRgb Materials::ground(Vec2d p) const {
  const auto shade = [&](LinearRgb color, const Spectrum& spectrum) {
    return std::max(0.1f, 1 + contrast_ * mottle(spectrum, per_finest_ * p, seed_)) * color;
  };
  // Coarse noise in [-1, 1] with finer noise of +-0.5 on it, or -1 where it cannot reach `least` (most places).
  const auto patches = [&](double size_m, std::uint32_t seed, float least) {
    const float coarse = value_noise(p.x / size_m, p.y / size_m, seed);
    if (coarse < least - 0.5f) return -1.f;
    return coarse + 0.5f * value_noise(4.3 * p.x / size_m, 4.3 * p.y / size_m, seed + 1);
  };
  const auto greens = [&](float dryness) {
    const float dry = ramp(patches(7, seed_ + 11, -1) + dryness, -0.7f, 0.9f);
    LinearRgb color = blend(kGrassColor, kDryGrassColor, dry);
    if (contrast_ > 0) {
      color = blend(color, kSoilColor, ramp(patches(4.3, seed_ + 13, 0.65f), 0.65f, 0.8f));
      color = blend(color, kShrubColor, ramp(patches(3.1, seed_ + 15, 0.66f), 0.66f, 0.78f));
    }
    return shade(color, kLawn);
  };
  if (!streets_) return greens(0);

  const Vec2d q = streets_->to_plan(p);
  const StreetPlan::Place place = streets_->place(q);
  const double into_street = std::max(place.outside.x, place.outside.y);
  const double pavement = 0.2 * streets_->street_m();
  if (into_street > pavement) {  // carriageway, with a dashed line along its middle away from the crossings
    const bool crossing = std::min(place.outside.x, place.outside.y) > 0;
    const double to_middle = 0.5 * streets_->street_m() - into_street;
    const double along = place.outside.x > 0 ? q.y : q.x;
    const bool dash = !crossing && to_middle < 0.07 && along / 6 - floor_int(along / 6) < 0.5;
    const float worn = 0.12f * value_noise(q.x / 2.7, q.y / 2.7, seed_ + 21);
    return shade((1 + contrast_ * worn) * (dash ? kMarkingColor : kAsphaltColor), kAsphalt);
  }
  if (into_street > 0) {  // pavement of slabs
    const Vec2d slab = 2.0 * q;
    const int i = floor_int(slab.x), j = floor_int(slab.y);
    const bool joint = slab.x - i < 0.05 || slab.y - j < 0.05;
    const float tone = 1 + contrast_ * (0.12f * lattice_value(i, j, seed_ + 31) - (joint ? 0.35f : 0.f));
    return shade(tone * kPavingColor, kPaving);
  }
  // Yards: what covers the ground changes from quarter to quarter of a block.
  const std::uint32_t yard =
      lattice_hash(2 * place.block_x + (place.in_block.x > 0), 2 * place.block_y + (place.in_block.y > 0), seed_ + 41);
  if (yard % 8 == 0) return shade(kGravelColor, kGravel);
  if (yard % 8 == 1) return shade(1.3f * kAsphaltColor, kAsphalt);
  return greens(unit(yard) - 0.5f);
}

LinearRgb Materials::top(const SolidBox& box, Vec2d local) const {
  const auto shade = [&](LinearRgb color, const Spectrum& spectrum) {
    return std::max(0.1f, 1 + contrast_ * mottle(spectrum, per_finest_ * local, box.seed)) * color;
  };
  if (box.kind == BoxKind::car) {
    const bool windows = std::abs(std::abs(local.x + 0.2) - 1.0) < 0.3 && std::abs(local.y) < 0.7;
    return shade(windows ? kGlassColor : pick(kCarColors, box.seed), kPaint);
  }
  if (box.kind == BoxKind::roof_unit || box.seed % 3 == 0) {  // gravel or bitumen between seams of the sheets
    const double sheet = local.y / 1.1;
    const bool seam = sheet - floor_int(sheet) < 0.06;
    const float stain = 0.22f * value_noise(local.x / 2.3, local.y / 2.3, box.seed + 51);
    return shade((1 + contrast_ * (stain - (seam ? 0.3f : 0.f))) * pick(kFlatRoofColors, box.seed), kGravel);
  }
  // Rows of tiles: each tile has its tone, its lower edge a shadow.
  const double row = local.y / 0.33;
  const int j = floor_int(row);
  const double column = local.x / 0.24 + 0.5 * (j & 1);
  const int i = floor_int(column);
  const auto in_row = static_cast<float>(row - j);
  const float tile = 0.26f * lattice_value(i, j, box.seed + 61) - 0.45f * ramp(in_row, 0.75f, 1.f);
  const float moss = 0.25f * value_noise(local.x / 1.7, local.y / 1.7, box.seed + 62);
  return shade(std::max(0.2f, 1 + contrast_ * (tile + moss)) * pick(kTileColors, box.seed), kTiles);
}

LinearRgb Materials::wall(const SolidBox& box, const SurfacePoint& point) const {
  const Vec2d local = box.local({point.position.x, point.position.y});
  const double facing_u = dot(Vec2d{point.normal.x, point.normal.y}, box.axis_u);
  const double facing_v = dot(Vec2d{point.normal.x, point.normal.y}, box.axis_v());
  const bool across_u = std::abs(facing_u) > std::abs(facing_v);
  const double along = across_u ? local.y : local.x;
  const double below_roof = box.z_high - point.position.z;
  // Each wall has noise of its own.
  const std::uint32_t seed = box.seed + 71 + (across_u ? 0 : 2) + (facing_u + facing_v > 0);
  const auto shade = [&](LinearRgb color, const Spectrum& spectrum) {
    return std::max(0.1f, 1 + contrast_ * mottle(spectrum, per_finest_ * Vec2d{along, below_roof}, seed)) * color;
  };
  if (box.kind == BoxKind::car) return shade(pick(kCarColors, box.seed), kPaint);
  if (box.kind == BoxKind::roof_unit) return shade(pick(kWallColors, box.seed), kPlaster);
  const double bay = along / 2.8, storey = (below_roof - 0.4) / 3.0;
  const double in_bay = bay - floor_int(bay), in_storey = storey - floor_int(storey);
  const bool window = storey > 0 && in_bay > 0.3 && in_bay < 0.72 && in_storey > 0.2 && in_storey < 0.68;
  if (!window) return shade(pick(kWallColors, box.seed), kPlaster);
  const float curtain = unit(lattice_hash(floor_int(bay), floor_int(storey), seed + 5));
  return shade(blend(kGlassColor, {0.3f, 0.3f, 0.28f}, 0.5f * curtain * curtain), kPaint);
}

}  // namespace skysweep::scene
