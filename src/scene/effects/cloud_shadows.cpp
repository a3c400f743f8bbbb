// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/cloud_shadows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kCloudStream = 0xeffc10;
// Of the thickness, over which a shadow fades: the sun is not a point.
constexpr double kPenumbra = 0.06;

class Clouds final : public SunFilter {
 public:
  Clouds(const CloudShadowsEffect& effect, Vec2d moved) : effect_(effect), moved_(moved) {}

  void dim(const SurfacePoint* hits, int count, Vec3d towards_sun, float* sun) const override {
    const Stopwatch stopwatch(effect_.meter(), 0);
    for (int i = 0; i < count; ++i) {
      if (!(sun[i] > 0)) continue;
      const double up = (effect_.settings().base_m - hits[i].position.z) / towards_sun.z;
      const Vec2d in_layer{hits[i].position.x + up * towards_sun.x, hits[i].position.y + up * towards_sun.y};
      sun[i] *= static_cast<float>(1 - effect_.taken_at(in_layer - moved_));
    }
  }

 private:
  const CloudShadowsEffect& effect_;
  Vec2d moved_;
};

}  // namespace

std::vector<Dial> dials(CloudShadows& s) {
  return {{"cover", &s.cover, kAboveZero, 1, true},
          {"density", &s.density, kAboveZero, 1},
          {"size_m", &s.size_m, kAboveZero},
          {"wind_mps", &s.wind_mps, 0, 100},
          {"wind_from_deg", &s.wind_from_deg, -360, 360},
          {"base_m", &s.base_m, 0, 20000}};
}

CloudShadowsEffect::CloudShadowsEffect(const CloudShadows& settings, const Scene& scene, const std::vector<Shot>&)
    : LightEffect(EffectId::cloud_shadows),
      settings_(settings),
      seed_(static_cast<std::uint32_t>(mix64(mix64(scene.seed) ^ kCloudStream))) {
  // The rim lies where `cover` of a large piece of sky is thicker.
  std::vector<double> found;
  Random random(seed_);
  for (int i = 0; i < 20000; ++i)
    found.push_back(thickness({random.uniform(0, 200 * settings.size_m), random.uniform(0, 200 * settings.size_m)}));
  std::sort(found.begin(), found.end());
  const auto rank = static_cast<std::size_t>((1 - settings.cover) * static_cast<double>(found.size() - 1));
  edge_ = settings.cover == 1 ? found.front() - 1 : found[rank];
}

double CloudShadowsEffect::thickness(Vec2d place) const {
  const Vec2d q = (1 / settings_.size_m) * place;
  return value_noise(q.x, q.y, seed_) + 0.5 * value_noise(2.03 * q.x, 2.03 * q.y, seed_ + 1) +
         0.25 * value_noise(4.1 * q.x, 4.1 * q.y, seed_ + 2);
}

double CloudShadowsEffect::taken_at(Vec2d place) const {
  const double inside = std::clamp((thickness(place) - edge_) / kPenumbra + 0.5, 0.0, 1.0);
  return settings_.density * inside * inside * (3 - 2 * inside);
}

void CloudShadowsEffect::change(const Shot& shot, const World&, Moment& moment) const {
  const double from = settings_.wind_from_deg * std::numbers::pi / 180;
  const double way_m = settings_.wind_mps * shot.time_s;
  moment.clouds = std::make_shared<Clouds>(*this, Vec2d{-way_m * std::sin(from), -way_m * std::cos(from)});
}

}  // namespace skysweep::scene
