// SPDX-License-Identifier: Apache-2.0
#include "render/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skysweep::render {
namespace {

constexpr Vec3d kUnknownColor{150, 150, 150};  // a known height whose number or colour is not known
constexpr Vec3d kUnderside{70, 66, 64};        // the surface seen from below
constexpr double kHatchPx = 5;                 // width of a stripe
constexpr Vec3d kHatchLight{235, 235, 235}, kHatchDark{170, 170, 175};
constexpr double kSteepest = 60;  // degrees, at the end of the colours of slope

Vec3d hatch(Vec2d pixel) {
  return static_cast<long long>(std::floor((pixel.x + pixel.y) / kHatchPx)) % 2 ? kHatchDark : kHatchLight;
}

// Share of the light that comes from the sky, and factor that keeps level ground lit at 45 degrees near its
// own colour.
struct Lighting {
  double ambient, brightness;
};
Lighting lighting_of(Look look) {
  switch (look) {
    case Look::hillshade: return {0.35, 1.2};
    case Look::relief: return {0.35, 1.25};
    case Look::orthophoto: return {0.45, 1.25};
    default: return {0.65, 1.2};  // numbers have to stay readable
  }
}

std::optional<Scale> scale_of(const MapScene& scene, const LookOptions& options, const ViewCounts* counts) {
  const Box3d& box = scene.true_bounds();
  switch (options.look) {
    case Look::relief: {
      const auto span = options.relief_span_m.value_or(raster::HeightSpan{box.min.z, box.max.z});
      return Scale{&relief_palette(), span.low_m, span.high_m, "height, m"};
    }
    case Look::slope: return Scale{&slope_palette(), 0, kSteepest, "slope, degrees"};
    case Look::confidence: return Scale{&confidence_palette(), 0, scene.usual_largest_sigma_m(), "sigma of height, m"};
    case Look::views: return Scale{&count_palette(), 0, 1. * (counts ? counts->most() : 0), "photographs", true};
    case Look::level: return Scale{nullptr, 0, 7, "level", true};
    default: return std::nullopt;
  }
}

}  // namespace

Shading::Shading(const MapScene& scene, const LookOptions& options, const View& view, const ViewCounts* counts)
    : scene_(scene),
      options_(options),
      pixel_(view.pixel()),
      counts_(counts),
      sun_(options.sun.value_or(usual_sun(view)).direction()),
      scale_(scale_of(scene, options, counts)) {}

double Shading::level_at(const Hit& hit) const {
  return std::max(0.0, std::log2(pixel_.at(hit.distance_m) / scene_.field()->cell_m));
}

std::optional<double> Shading::number(Vec3d place, const Hit& hit) const {
  switch (options_.look) {
    case Look::relief: return scene_.true_height_m(place);
    case Look::slope: {
      const double up = scene_.true_normal(place, level_at(hit)).z;
      return std::acos(std::clamp(up, 0.0, 1.0)) * 180 / std::numbers::pi;
    }
    case Look::confidence: return scene_.sigma_m(place);
    case Look::views: return counts_->at({place.x, place.y, scene_.true_height_m(place)});
    default: return std::nullopt;
  }
}

Vec3d Shading::base_color(Vec3d place, const Hit& hit) const {
  switch (options_.look) {
    case Look::orthophoto: return scene_.color(place, level_at(hit)).value_or(kUnknownColor);
    case Look::hillshade: return {255, 255, 255};
    case Look::level: return level_color(scene_.map_level() + hit.level);
    default: {
      const std::optional<double> n = number(place, hit);
      return n ? scale_->palette->at(scale_->share(*n)) : kUnknownColor;
    }
  }
}

Vec3d Shading::background() const {
  return {1. * options_.background.r, 1. * options_.background.g, 1. * options_.background.b};
}

Vec3d Shading::normal(const Ray& ray, const Hit& hit) const {
  const auto against = [](double direction) { return direction > 0 ? -1.0 : 1.0; };
  if (hit.face == Face::wall_x) return {against(ray.direction.x), 0, 0};
  if (hit.face == Face::wall_y) return {0, against(ray.direction.y), 0};
  return scene_.normal(along(ray, hit.distance_m), level_at(hit));
}

Vec3d Shading::color(const Ray& ray, const Hit& hit, bool in_shadow, Vec2d pixel) const {
  if (!hit.any()) return background();
  if (hit.from_below) return kUnderside;
  const Vec3d place = along(ray, hit.distance_m);
  if (scene_.is_hole(place)) return hatch(pixel);
  const Vec3d base = base_color(place, hit);
  if (!options_.is_lit()) return base;
  const Lighting light = lighting_of(options_.look);
  const Vec3d n = normal(ray, hit);
  const double sun = in_shadow ? 0 : std::max(0.0, dot(n, sun_));
  // The sky opposite of the sun lights what is turned away, so that faces in the shade differ, too.
  const double sky = 0.5 + 0.5 * dot(n, {-sun_.x, -sun_.y, sun_.z});
  const Vec3d lit = light.brightness * (light.ambient * sky + (1 - light.ambient) * sun) * base;
  return {std::min(lit.x, 255.0), std::min(lit.y, 255.0), std::min(lit.z, 255.0)};
}

std::optional<Ray> Shading::shadow_ray(const Ray& ray, const Hit& hit) const {
  const Vec3d n = normal(ray, hit);
  if (hit.from_below || dot(n, sun_) <= 0) return std::nullopt;
  // A shadow begins at half a cell's distance: nearer, a patch would shade itself through the stop of detail.
  const double lift = 0.25 * std::max(scene_.field()->cell_m, pixel_.at(hit.distance_m));
  return Ray{along(ray, hit.distance_m) + lift * n + lift * sun_, sun_};
}

}  // namespace skysweep::render
