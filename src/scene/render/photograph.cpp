// SPDX-License-Identifier: Apache-2.0
#include "scene/render/photograph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "scene/render/encoding.h"

namespace skysweep::scene {
namespace {

// A rotated grid: no two samples share a row or a column, so that edges near the axes get four steps.
constexpr std::array<Vec2d, 4> kSamples = {{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
constexpr int kSamplesPerGroup = static_cast<int>(kSamples.size());
constexpr int kPixelsPerBatch = Tracer::kBatch / kSamplesPerGroup;

// Within its pixel. Each further group is the same grid, shifted by a sequence that fills the pixel evenly (of the
// plastic number: Roberts 2018).
Vec2d place_of_sample(int group, int sample) {
  constexpr Vec2d kShift{0.7548776662466927, 0.5698402909980532};
  const Vec2d at = kSamples[static_cast<std::size_t>(sample)] + group * kShift;
  return {at.x - std::floor(at.x), at.y - std::floor(at.y)};
}

// What has been seen of a pixel so far.
struct PixelSum {
  LinearRgb light;
  float levels = 0, squares = 0;  // of the samples' grey levels
  int samples = 0;

  LinearRgb mean() const { return 1.f / static_cast<float>(samples) * light; }
  // Standard error of the mean, grey levels.
  float error() const {
    const auto n = static_cast<float>(samples);
    return std::sqrt(std::max(0.f, squares - levels * levels / n) / (n * (n - 1)));
  }
};

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

// What the pixels of the film see, before exposure.
class Film {
 public:
  Film(const World& world, const camera::CameraModel& model, const PixelRays& rays, const camera::Pose& pose,
       const Sampling& sampling, const PhotographEffects* effects)
      : world_(world),
        model_(model),
        rays_(rays),
        pose_(pose),
        world_from_cam_(transpose(pose.cam_from_world)),
        sampling_(sampling),
        effects_(effects) {}

  // `on_row` is null without effects.
  std::vector<LinearRgb> row(int row, RowEffects* on_row) const {
    std::vector<PixelSum> sums(static_cast<std::size_t>(model_.width_px));
    std::vector<int> columns(sums.size());
    std::iota(columns.begin(), columns.end(), 0);
    add_group(0, row, columns, on_row, sums);
    if (sampling_.max_error_levels > 0 && !(effects_ && effects_->rounds() > 1)) refine(row, columns, on_row, sums);
    std::vector<LinearRgb> line;
    for (const PixelSum& sum : sums) line.push_back(sum.mean());
    return line;
  }

 private:
  // Further groups of samples for pixels whose mean is not sure enough.
  void refine(int row, std::vector<int> columns, RowEffects* on_row, std::vector<PixelSum>& sums) const {
    const auto sure = [&](int column) {
      return sums[static_cast<std::size_t>(column)].error() <= sampling_.max_error_levels;
    };
    for (int group = 1; group < Sampling::kMostSamples / kSamplesPerGroup; ++group) {
      std::erase_if(columns, sure);
      if (columns.empty()) return;
      add_group(group, row, columns, on_row, sums);
    }
  }

  void add_group(int group, int row, const std::vector<int>& columns, RowEffects* on_row,
                 std::vector<PixelSum>& sums) const {
    for (std::size_t first = 0; first < columns.size(); first += kPixelsPerBatch) {
      const int pixels = static_cast<int>(std::min<std::size_t>(kPixelsPerBatch, columns.size() - first));
      if (on_row)
        see_through_effects(group, row, columns.data() + first, pixels, *on_row, sums);
      else
        see(group, row, columns.data() + first, pixels, sums);
    }
  }

  // Direction of a batch's sample in the camera's frame. A pixel that the lens model cannot reach looks straight ahead;
  // it stays black in the photograph.
  Vec3d direction(int group, int row, const int* columns, int i) const {
    const int column = columns[i / kSamplesPerGroup];
    if (!rays_.valid(column, row)) return {0, 0, 1};
    return rays_.direction(column, row, place_of_sample(group, i % kSamplesPerGroup));
  }

  void add(const int* columns, int pixels, const LinearRgb* light, std::vector<PixelSum>& sums) const {
    for (int i = 0; i < pixels * kSamplesPerGroup; ++i) {
      PixelSum& sum = sums[static_cast<std::size_t>(columns[i / kSamplesPerGroup])];
      sum.light = sum.light + light[i];
      ++sum.samples;
      if (sampling_.max_error_levels <= 0) continue;
      const float level = srgb_level(0.2126f * light[i].r + 0.7152f * light[i].g + 0.0722f * light[i].b);
      sum.levels += level;
      sum.squares += level * level;
    }
  }

  void see(int group, int row, const int* columns, int pixels, std::vector<PixelSum>& sums) const {
    std::array<Ray, Tracer::kBatch> batch;
    std::array<SurfacePoint, Tracer::kBatch> hits;
    std::array<LinearRgb, Tracer::kBatch> light;
    const int count = pixels * kSamplesPerGroup;
    for (int i = 0; i < count; ++i)
      batch[static_cast<std::size_t>(i)] = {pose_.center, world_from_cam_ * direction(group, row, columns, i)};
    world_.look(batch.data(), count, hits.data(), light.data());
    add(columns, pixels, light.data(), sums);
  }

  void see_through_effects(int group, int row, const int* columns, int pixels, RowEffects& on_row,
                           std::vector<PixelSum>& sums) const {
    std::array<Ray, Tracer::kBatch> rays;
    std::array<SurfacePoint, Tracer::kBatch> hits;
    std::array<LinearRgb, Tracer::kBatch> light, sample;
    SampleBatch batch;
    batch.row = row;
    batch.rounds = effects_->rounds();
    batch.samples_of_round = kSamplesPerGroup;
    batch.count = pixels * kSamplesPerGroup;
    const bool apart = effects_->channels_apart();
    const Vec3d velocity = effects_->velocity_mps();
    for (batch.round = 0; batch.round < batch.rounds; ++batch.round) {
      for (batch.channel = apart ? 0 : -1; batch.channel < (apart ? 3 : 0); ++batch.channel) {
        for (int i = 0; i < batch.count; ++i) {
          const auto at = static_cast<std::size_t>(i);
          batch.direction[at] = direction(group, row, columns, i);
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
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
          if (batch.channel <= 0) sample[i].r = light[i].r;
          if (batch.channel < 0 || batch.channel == 1) sample[i].g = light[i].g;
          if (batch.channel < 0 || batch.channel == 2) sample[i].b = light[i].b;
        }
      }
      add(columns, pixels, sample.data(), sums);
    }
  }

  const World& world_;
  const camera::CameraModel& model_;
  const PixelRays& rays_;
  const camera::Pose& pose_;
  Mat3d world_from_cam_;
  Sampling sampling_;
  const PhotographEffects* effects_;
};

// Calls put(column, row, light, gain) for every pixel that the lens model reaches: what its light still has to be
// multiplied by.
template <typename Put>
void for_each_pixel(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                    const camera::Pose& pose, const Exposure& exposure, const Sampling& sampling, Executor& executor,
                    const PhotographEffects* effects, Put put) {
  const Film film(world, model, rays, pose, sampling, effects);
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
                              const PhotographEffects* effects, const Sampling& sampling) {
  Array2d<Rgb8> photo(model.width_px, model.height_px);
  for_each_pixel(world, model, rays, pose, exposure, sampling, executor, effects,
                 [&](int column, int row, LinearRgb light, float gain) {
                   photo(column, row) = expose(light, gain, exposure, column, row);
                 });
  return photo;
}

Array2d<LinearRgb> take_linear_photograph(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                                          const camera::Pose& pose, const Exposure& exposure, Executor& executor,
                                          const PhotographEffects* effects, const Sampling& sampling) {
  Array2d<LinearRgb> photo(model.width_px, model.height_px);
  for_each_pixel(world, model, rays, pose, exposure, sampling, executor, effects,
                 [&](int column, int row, LinearRgb light, float gain) { photo(column, row) = gain * light; });
  return photo;
}

}  // namespace skysweep::scene
