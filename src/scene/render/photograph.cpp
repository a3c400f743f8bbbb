// SPDX-License-Identifier: Apache-2.0
#include "scene/render/photograph.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "core/random.h"
#include "scene/render/encoding.h"

namespace skysweep::scene {
namespace {

// A rotated grid: no two samples share a row or a column, so that edges near the axes get four steps.
constexpr std::array<Vec2d, 4> kSamples = {{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
constexpr int kSamplesPerPixel = static_cast<int>(kSamples.size());
constexpr int kPixelsPerBatch = Tracer::kBatch / kSamplesPerPixel;

Rgb8 expose(LinearRgb light, float gain, const Exposure& exposure, int column, int row) {
  std::array<float, 3> level = {srgb_level(gain * light.r), srgb_level(gain * light.g), srgb_level(gain * light.b)};
  if (exposure.noise_sigma > 0) {
    const auto place =
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) | static_cast<std::uint32_t>(column);
    Random random(exposure.noise_seed ^ mix64(place));
    for (float& v : level) v += static_cast<float>(exposure.noise_sigma * random.normal());
  }
  return {to_byte(level[0]), to_byte(level[1]), to_byte(level[2])};
}

// What a pixel of the film sees, before exposure.
class Film {
 public:
  Film(const World& world, const camera::CameraModel& model, const PixelRays& rays, const camera::Pose& pose,
       const PhotographEffects* effects)
      : world_(world),
        model_(model),
        rays_(rays),
        pose_(pose),
        world_from_cam_(transpose(pose.cam_from_world)),
        effects_(effects) {}

  // `on_row` is null without effects.
  std::vector<LinearRgb> row(int row, RowEffects* on_row) const {
    std::vector<LinearRgb> line(static_cast<std::size_t>(model_.width_px));
    for (int first = 0; first < model_.width_px; first += kPixelsPerBatch) {
      const int pixels = std::min(kPixelsPerBatch, model_.width_px - first);
      LinearRgb* const out = line.data() + first;
      if (on_row)
        see_through_effects(row, first, pixels, *on_row, out);
      else
        see(row, first, pixels, out);
    }
    return line;
  }

 private:
  // A pixel that the lens model cannot reach looks straight ahead; it stays black in the photograph.
  Vec3d direction(int column, int row, int sample) const {
    if (!rays_.valid(column, row)) return {0, 0, 1};
    return rays_.direction(column, row, kSamples[static_cast<std::size_t>(sample)]);
  }

  void see(int row, int first, int pixels, LinearRgb* out) const {
    std::array<Ray, Tracer::kBatch> batch;
    std::array<SurfacePoint, Tracer::kBatch> hits;
    std::array<LinearRgb, Tracer::kBatch> light;
    const int count = pixels * kSamplesPerPixel;
    for (int i = 0; i < count; ++i)
      batch[static_cast<std::size_t>(i)] = {
          pose_.center, world_from_cam_ * direction(first + i / kSamplesPerPixel, row, i % kSamplesPerPixel)};
    world_.look(batch.data(), count, hits.data(), light.data());
    for (int i = 0; i < count; ++i)
      out[i / kSamplesPerPixel] = out[i / kSamplesPerPixel] + light[static_cast<std::size_t>(i)];
    for (int p = 0; p < pixels; ++p) out[p] = 1.f / kSamplesPerPixel * out[p];
  }

  void see_through_effects(int row, int first, int pixels, RowEffects& on_row, LinearRgb* out) const {
    std::array<Ray, Tracer::kBatch> rays;
    std::array<SurfacePoint, Tracer::kBatch> hits;
    std::array<LinearRgb, Tracer::kBatch> light;
    SampleBatch batch;
    batch.row = row;
    batch.rounds = effects_->rounds();
    batch.samples_of_round = kSamplesPerPixel;
    batch.count = pixels * kSamplesPerPixel;
    const bool apart = effects_->channels_apart();
    const Vec3d velocity = effects_->velocity_mps();
    const float share = 1.f / static_cast<float>(kSamplesPerPixel * batch.rounds);
    for (batch.channel = apart ? 0 : -1; batch.channel < (apart ? 3 : 0); ++batch.channel)
      for (batch.round = 0; batch.round < batch.rounds; ++batch.round) {
        for (int i = 0; i < batch.count; ++i) {
          const auto at = static_cast<std::size_t>(i);
          batch.direction[at] = direction(first + i / kSamplesPerPixel, row, i % kSamplesPerPixel);
          batch.offset[at] = {};
          batch.time_s[at] = 0;
        }
        on_row.bend(batch);
        for (int i = 0; i < batch.count; ++i) {
          const auto at = static_cast<std::size_t>(i);
          rays[at] = {pose_.center + batch.time_s[at] * velocity + world_from_cam_ * batch.offset[at],
                      world_from_cam_ * batch.direction[at]};
        }
        world_.look(rays.data(), batch.count, hits.data(), light.data(), effects_->moment());
        on_row.through_air(rays.data(), hits.data(), batch.count, light.data());
        for (int i = 0; i < batch.count; ++i) {
          LinearRgb& sum = out[i / kSamplesPerPixel];
          const LinearRgb one = share * light[static_cast<std::size_t>(i)];
          if (batch.channel <= 0) sum.r += one.r;
          if (batch.channel < 0 || batch.channel == 1) sum.g += one.g;
          if (batch.channel < 0 || batch.channel == 2) sum.b += one.b;
        }
      }
  }

  const World& world_;
  const camera::CameraModel& model_;
  const PixelRays& rays_;
  const camera::Pose& pose_;
  Mat3d world_from_cam_;
  const PhotographEffects* effects_;
};

// Calls put(column, row, light, gain) for every pixel that the lens model reaches: what its light still has to be
// multiplied by.
template <typename Put>
void for_each_pixel(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                    const camera::Pose& pose, const Exposure& exposure, Executor& executor,
                    const PhotographEffects* effects, Put put) {
  const Film film(world, model, rays, pose, effects);
  executor.parallel_for(model.height_px, [&](int row) {
    const std::unique_ptr<RowEffects> on_row = effects ? effects->begin_row(row) : nullptr;
    std::vector<LinearRgb> line = film.row(row, on_row.get());
    auto gain = static_cast<float>(exposure.gain);
    if (on_row) {
      on_row->develop(line.data(), model.width_px, gain);
      gain = 1;
    }
    for (int column = 0; column < model.width_px; ++column)
      if (rays.valid(column, row)) put(column, row, line[static_cast<std::size_t>(column)], gain);
  });
}

}  // namespace

Array2d<Rgb8> take_photograph(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                              const camera::Pose& pose, const Exposure& exposure, Executor& executor,
                              const PhotographEffects* effects) {
  Array2d<Rgb8> photo(model.width_px, model.height_px);
  for_each_pixel(world, model, rays, pose, exposure, executor, effects,
                 [&](int column, int row, LinearRgb light, float gain) {
                   photo(column, row) = expose(light, gain, exposure, column, row);
                 });
  return photo;
}

Array2d<LinearRgb> take_linear_photograph(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                                          const camera::Pose& pose, const Exposure& exposure, Executor& executor,
                                          const PhotographEffects* effects) {
  Array2d<LinearRgb> photo(model.width_px, model.height_px);
  for_each_pixel(world, model, rays, pose, exposure, executor, effects,
                 [&](int column, int row, LinearRgb light, float gain) { photo(column, row) = gain * light; });
  return photo;
}

}  // namespace skysweep::scene
