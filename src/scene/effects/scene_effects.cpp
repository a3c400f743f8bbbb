// SPDX-License-Identifier: Apache-2.0
// The chain of the effects that a scene names, stage by stage.
#include "scene/effects/scene_effects.h"

#include <algorithm>
#include <type_traits>

#include "scene/effects/catalogue.h"
#include "scene/effects/shots.h"

namespace skysweep::scene {
namespace {

// The effects of a scene, by stage, in the order in which they act.
struct Chain {
  std::vector<std::unique_ptr<MetadataEffect>> metadata;
  std::vector<std::unique_ptr<RayEffect>> rays;
  std::vector<std::unique_ptr<LightEffect>> light;
  std::vector<std::unique_ptr<SurfaceEffect>> surface;
  std::vector<std::unique_ptr<AirEffect>> air;
  std::vector<std::unique_ptr<ImageEffect>> image;  // of the sensor too, as the last

  bool touches_photographs() const {
    return !(rays.empty() && light.empty() && surface.empty() && air.empty() && image.empty());
  }

  int rounds() const {
    int out = 1;
    for (const auto& effect : rays) out = std::max(out, effect->rounds());
    return out;
  }

  bool channels_apart() const {
    return std::any_of(rays.begin(), rays.end(), [](const auto& effect) { return effect->channels_apart(); });
  }

  void add(std::unique_ptr<MetadataEffect> effect) { metadata.push_back(std::move(effect)); }
  void add(std::unique_ptr<RayEffect> effect) { rays.push_back(std::move(effect)); }
  void add(std::unique_ptr<LightEffect> effect) { light.push_back(std::move(effect)); }
  void add(std::unique_ptr<SurfaceEffect> effect) { surface.push_back(std::move(effect)); }
  void add(std::unique_ptr<AirEffect> effect) { air.push_back(std::move(effect)); }
  void add(std::unique_ptr<ImageEffect> effect) { image.push_back(std::move(effect)); }

  template <typename Visitor>
  void for_each(Visitor&& visit) const {
    for (const auto& effect : metadata) visit(*effect);
    for (const auto& effect : rays) visit(*effect);
    for (const auto& effect : light) visit(*effect);
    for (const auto& effect : surface) visit(*effect);
    for (const auto& effect : air) visit(*effect);
    for (const auto& effect : image) visit(*effect);
  }
};

// Times of the effects of rays, surfaces and air are summed up for the row and told to their meters at its end.
class ChainOnRow final : public RowEffects {
 public:
  ChainOnRow(const Chain& chain, const Shot& shot, const World& world, const Moment& moment, int row)
      : chain_(chain),
        shot_(shot),
        world_(world),
        moment_(moment),
        row_(row),
        ray_times_(chain.rays.size()),
        surface_times_(chain.surface.size()),
        air_times_(chain.air.size()) {}

  ~ChainOnRow() override {
    for (std::size_t i = 0; i < ray_times_.size(); ++i) chain_.rays[i]->meter().add(1, ray_times_[i]);
    for (std::size_t i = 0; i < surface_times_.size(); ++i) chain_.surface[i]->meter().add(1, surface_times_[i]);
    for (std::size_t i = 0; i < air_times_.size(); ++i) chain_.air[i]->meter().add(1, air_times_[i]);
  }

  void bend(SampleBatch& batch) override {
    for (std::size_t i = 0; i < ray_times_.size(); ++i) {
      const Stopwatch stopwatch(ray_times_[i]);
      chain_.rays[i]->bend(batch);
    }
  }

  void through_air(const Ray* rays, const SurfacePoint* hits, int count, LinearRgb* light) override {
    for (std::size_t i = 0; i < surface_times_.size(); ++i) {
      const Stopwatch stopwatch(surface_times_[i]);
      chain_.surface[i]->shine(shot_, world_, moment_, rays, hits, count, light);
    }
    for (std::size_t i = 0; i < air_times_.size(); ++i) {
      const Stopwatch stopwatch(air_times_[i]);
      chain_.air[i]->dim(rays, hits, count, light);
    }
  }

  void develop(LinearRgb* row, int width, float gain) override {
    for (int i = 0; i < width; ++i) row[i] = gain * row[i];
    for (const auto& effect : chain_.image) {
      const Stopwatch stopwatch(effect->meter(), 1);
      effect->develop(shot_, row_, row, width);
    }
  }

 private:
  const Chain& chain_;
  const Shot& shot_;
  const World& world_;
  const Moment& moment_;
  int row_;
  std::vector<std::chrono::steady_clock::duration> ray_times_, surface_times_, air_times_;
};

class ChainOnPhotograph final : public PhotographEffects {
 public:
  ChainOnPhotograph(const Chain& chain, const Shot& shot, const World& world)
      : chain_(chain), shot_(shot), world_(world), moment_(world.moment()) {
    for (const auto& effect : chain.light) {
      const Stopwatch stopwatch(effect->meter(), 1);
      effect->change(shot, world, moment_);
    }
  }

  int rounds() const override { return chain_.rounds(); }
  bool channels_apart() const override { return chain_.channels_apart(); }
  Vec3d velocity_mps() const override { return shot_.velocity_mps; }
  const Moment& moment() const override { return moment_; }
  std::unique_ptr<RowEffects> begin_row(int row) const override {
    return std::make_unique<ChainOnRow>(chain_, shot_, world_, moment_, row);
  }

 private:
  const Chain& chain_;
  const Shot& shot_;
  const World& world_;
  Moment moment_;
};

class NamedEffects final : public SceneEffects {
 public:
  NamedEffects(const Scene& scene, const std::vector<camera::Pose>& poses)
      : scene_(scene), shots_(shots_of(poses, scene.effects.speed_mps)) {
    for_each_effect(scene.effects, [&]<typename Class>(const EffectInfo&, const auto& settings, Makes<Class>) {
      if (settings) chain_.add(std::make_unique<Class>(*settings, scene, shots_));
    });
  }

  std::vector<formats::PosedImage> recorded(std::vector<formats::PosedImage> images) const override {
    for (const auto& effect : chain_.metadata) {
      const Stopwatch stopwatch(effect->meter(), static_cast<long long>(images.size()));
      effect->spoil(shots_, images);
    }
    return images;
  }

  bool spoils_metadata() const override { return !chain_.metadata.empty(); }

  void change_world(World& world) const override {
    Moment moment = world.moment();
    for (const auto& effect : chain_.light) effect->change_always(moment);
    world.set_moment(moment);
  }

  std::unique_ptr<PhotographEffects> photograph(std::size_t index, const World& world) const override {
    if (!chain_.touches_photographs()) return nullptr;
    return std::make_unique<ChainOnPhotograph>(chain_, shots_[index], world);
  }

  int rays_per_pixel() const override { return 4 * chain_.rounds() * (chain_.channels_apart() ? 3 : 1); }

  std::vector<EffectReport> report() const override {
    std::vector<EffectReport> out;
    for_each_effect(scene_.effects, [&](const EffectInfo& info, const auto& settings, auto) {
      EffectReport line{info.name, to_string(info.stage), info.what, settings ? settings->named_at : "", 0, 0};
      chain_.for_each([&](const Effect& effect) {
        if (effect.id() != info.id) return;
        line.calls = effect.meter().calls();
        line.seconds = effect.meter().seconds();
      });
      out.push_back(line);
    });
    return out;
  }

 private:
  const Scene& scene_;
  std::vector<Shot> shots_;
  Chain chain_;
};

}  // namespace

std::unique_ptr<SceneEffects> make_effects(const Scene& scene, const std::vector<camera::Pose>& poses) {
  bool any = false;
  for_each_effect(scene.effects, [&](const EffectInfo&, const auto& settings, auto) { any = any || settings; });
  return any ? std::make_unique<NamedEffects>(scene, poses) : nullptr;
}

std::vector<EffectReport> nothing_runs() {
  std::vector<EffectReport> out;
  const Effects none;
  for_each_effect(none, [&](const EffectInfo& info, const auto&, auto) {
    out.push_back({info.name, to_string(info.stage), info.what, "", 0, 0});
  });
  return out;
}

}  // namespace skysweep::scene
