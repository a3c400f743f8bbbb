// SPDX-License-Identifier: Apache-2.0
#include "scene/world/ground_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "raster/geotiff.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

constexpr LinearRgb kRockColor{0.30f, 0.255f, 0.20f}, kSandColor{0.50f, 0.42f, 0.29f},
    kWetSandColor{0.25f, 0.20f, 0.13f}, kWaterColor{0.025f, 0.075f, 0.095f}, kAsphaltColor{0.115f, 0.115f, 0.12f},
    kTileColor{0.34f, 0.31f, 0.27f}, kJointColor{0.12f, 0.11f, 0.10f}, kGravelColor{0.37f, 0.335f, 0.27f};

LinearRgb blend(LinearRgb a, LinearRgb b, float t) { return (1 - t) * a + t * b; }

// 0 to 1 as v goes from low to high.
float ramp(double v, double low, double high) {
  return static_cast<float>(std::clamp((v - low) / (high - low), 0., 1.));
}

// Index of a mirrored image: what lies beyond its border is what lies before it.
int mirrored(int i, int count) {
  const int period = 2 * count;
  const int in_period = ((i % period) + period) % period;
  return in_period < count ? in_period : period - 1 - in_period;
}

double dug_below(const Terrain& terrain) {
  const auto* quarry = std::get_if<QuarryTerrain>(&terrain.shape);
  return quarry ? -0.5 * terrain.relief_m - 0.2 : -std::numeric_limits<double>::infinity();
}

}  // namespace

GroundCover::GroundCover(const Scene& scene, const Ground& ground)
    : ground_(ground),
      kind_(scene.texture.ground),
      bares_(!ground.plain()),
      dug_below_m_(dug_below(scene.terrain)),
      period_m_(scene.texture.period_m),
      finest_m_(scene.finest_detail_m()),
      contrast_(static_cast<float>(scene.texture.contrast)),
      seed_(static_cast<std::uint32_t>(mix64(scene.seed ^ 0x6c0e))) {
  if (kind_ != GroundTexture::image) return;
  const raster::Raster<Rgba8> photo = raster::read_color_raster(scene.texture.image);
  const Vec2d corner{scene.origin.x, scene.origin.y};
  if (!photo.extent().contains(corner) || !photo.extent().contains(corner + scene.area_m))
    throw usage_error(scene.texture.image.string() + " does not cover the mapped area: set origin and area_m");
  image_ = photo.values;
  image_corner_ = photo.georeference.north_west_corner - corner;
  image_cell_m_ = photo.georeference.cell_m;
  for (std::size_t i = 0; i < linear_.size(); ++i) {
    const double v = static_cast<double>(i) / 255;
    linear_[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
}

LinearRgb GroundCover::replacement(Vec2d p) const {
  switch (kind_) {
    case GroundTexture::tiles: return tile(p);
    case GroundTexture::checker: return checker(p);
    case GroundTexture::image: return image(p);
    default: return kAsphaltColor;
  }
}

LinearRgb GroundCover::tile(Vec2d p) const {
  const Vec2d in_periods = (1 / period_m_) * p;
  const Vec2d within{in_periods.x - floor_int(in_periods.x), in_periods.y - floor_int(in_periods.y)};
  constexpr double kJoint = 0.03;
  if (within.x < kJoint || within.y < kJoint) return kJointColor;
  return std::max(0.1f, 1 + 0.8f * contrast_ * detail(period_m_ * within, 0.5 * period_m_, seed_ + 81)) * kTileColor;
}

LinearRgb GroundCover::checker(Vec2d p) const {
  const bool dark = ((floor_int(p.x / period_m_) + floor_int(p.y / period_m_)) & 1) != 0;
  const float grey = std::clamp(0.30f + (dark ? -0.15f : 0.15f) * contrast_, 0.02f, 0.9f);
  return {grey, grey, grey};
}

LinearRgb GroundCover::image(Vec2d p) const {
  const double x = (p.x - image_corner_.x) / image_cell_m_ - 0.5, y = (image_corner_.y - p.y) / image_cell_m_ - 0.5;
  const int i = floor_int(x), j = floor_int(y);
  const auto at = [&](int column, int row) {
    const Rgba8 c = image_(mirrored(column, image_.width()), mirrored(row, image_.height()));
    return LinearRgb{linear_[c.r], linear_[c.g], linear_[c.b]};
  };
  const auto s = static_cast<float>(x - i), t = static_cast<float>(y - j);
  return blend(blend(at(i, j), at(i + 1, j), s), blend(at(i, j + 1), at(i + 1, j + 1), s), t);
}

float GroundCover::detail(Vec2d p, double coarsest_m, std::uint32_t seed) const {
  float sum = 0, weights = 0, weight = 1;
  for (double size = finest_m_; size <= std::max(coarsest_m, finest_m_); size *= 2.1) {
    sum += weight * value_noise(p.x / size, p.y / size, seed);
    weights += 0.55f * weight;  // values near the sum of all weights are rare
    seed += 0x51ed27u;
    weight = std::max(0.6f * weight, 0.3f);
  }
  return std::clamp(sum / weights, -1.f, 1.f);
}

LinearRgb GroundCover::rock(Vec3d position, Vec3d normal) const {
  // Detail from three sides, so that no face shows it stretched.
  constexpr double kCoarsest_m = 3;
  const Vec3d share{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const double sum = share.x + share.y + share.z;
  float grain = 0;
  if (share.x > 0.02 * sum)
    grain += static_cast<float>(share.x / sum) * detail({position.y, position.z}, kCoarsest_m, seed_ + 91);
  if (share.y > 0.02 * sum)
    grain += static_cast<float>(share.y / sum) * detail({position.x, position.z}, kCoarsest_m, seed_ + 92);
  if (share.z > 0.02 * sum)
    grain += static_cast<float>(share.z / sum) * detail({position.x, position.y}, kCoarsest_m, seed_ + 93);
  // Layers, slightly wavy.
  const double wave = 0.3 * value_noise(position.x / 7, position.y / 7, seed_ + 94);
  const float layer = value_noise((position.z + wave) / 0.55, 0.5, seed_ + 95);
  return std::max(0.15f, 1 + contrast_ * (1.1f * grain + 0.22f * layer)) * kRockColor;
}

LinearRgb GroundCover::bared(LinearRgb cover, Vec3d position, Vec3d normal) const {
  const Vec2d p{position.x, position.y};
  const float tone =
      0.16f * value_noise(p.x / 31, p.y / 31, seed_ + 96) + 0.12f * value_noise(p.x / 13, p.y / 13, seed_ + 97);
  LinearRgb out = (1 + contrast_ * tone) * cover;
  const float patchy =
      value_noise(p.x / 2.3, p.y / 2.3, seed_ + 98) + 0.6f * value_noise(p.x / 0.6, p.y / 0.6, seed_ + 99);
  if (position.z < dug_below_m_) {
    const float tracks = value_noise(p.x / 1.1, p.y / 3.7, seed_ + 104);
    out = std::max(0.2f, 1 + contrast_ * (0.6f * detail(p, 4, seed_ + 105) + 0.12f * tracks)) * kGravelColor;
  }
  if (const auto level = ground_.water_level_m()) {
    const double above = position.z - *level + 0.12 * patchy;
    const float sandy = 1 - ramp(above, 0.45, 0.75);
    if (sandy > 0) {
      const LinearRgb sand = blend(kWetSandColor, kSandColor, ramp(above, 0.05, 0.2));
      out = blend(out, std::max(0.2f, 1 + 0.45f * contrast_ * detail(p, 1.5, seed_ + 101)) * sand, sandy);
    }
  }
  constexpr double kRockFrom = 0.62, kRockAll = 0.8;  // slope, dz over way
  const double slope = std::sqrt(std::max(0., 1 / (normal.z * normal.z) - 1)) + 0.1 * patchy;
  const float rocky = ramp(slope, kRockFrom, kRockAll);
  return rocky > 0 ? blend(out, rock(position, normal), rocky) : out;
}

LinearRgb GroundCover::water(Vec3d position) const {
  const Vec2d p{position.x, position.y};
  const double depth = std::max(0., position.z - ground_.at(p).z);
  const auto seen = static_cast<float>(std::exp(-depth / 0.9));
  const LinearRgb bed = std::max(0.2f, 1 + 0.45f * contrast_ * detail(p, 1.5, seed_ + 101)) * kWetSandColor;
  const float ripples = contrast_ * (0.10f * value_noise(p.x / 0.5, p.y / 1.1, seed_ + 102) +
                                     0.10f * value_noise(p.x / 9, p.y / 9, seed_ + 103));
  return blend((1 + ripples) * kWaterColor, bed, 0.9f * seen);
}

}  // namespace skysweep::scene
