// SPDX-License-Identifier: Apache-2.0
#include "scene/render/photograph.h"

#include <algorithm>
#include <array>

#include "core/random.h"
#include "scene/render/encoding.h"

namespace skysweep::scene {
namespace {

// A rotated grid: no two samples share a row or a column, so that edges near the axes get four steps.
constexpr std::array<Vec2d, 4> kSamples = {{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
constexpr int kSamplesPerPixel = static_cast<int>(kSamples.size());
constexpr int kPixelsPerBatch = Tracer::kBatch / kSamplesPerPixel;

Rgb8 expose(LinearRgb light, const Exposure& exposure, int column, int row) {
  const auto gain = static_cast<float>(exposure.gain);
  std::array<float, 3> level = {srgb_level(gain * light.r), srgb_level(gain * light.g), srgb_level(gain * light.b)};
  if (exposure.noise_sigma > 0) {
    const auto place =
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) | static_cast<std::uint32_t>(column);
    Random random(exposure.noise_seed ^ mix64(place));
    for (float& v : level) v += static_cast<float>(exposure.noise_sigma * random.normal());
  }
  return {to_byte(level[0]), to_byte(level[1]), to_byte(level[2])};
}

}  // namespace

Array2d<Rgb8> take_photograph(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                              const camera::Pose& pose, const Exposure& exposure, Executor& executor) {
  Array2d<Rgb8> photo(model.width_px, model.height_px);
  const Mat3d world_from_cam = transpose(pose.cam_from_world);
  executor.parallel_for(model.height_px, [&](int row) {
    std::array<Ray, Tracer::kBatch> batch;
    std::array<SurfacePoint, Tracer::kBatch> hits;
    std::array<LinearRgb, Tracer::kBatch> light;
    for (int first = 0; first < model.width_px; first += kPixelsPerBatch) {
      const int pixels = std::min(kPixelsPerBatch, model.width_px - first);
      for (int p = 0; p < pixels; ++p) {
        // A pixel that the lens model cannot reach looks straight ahead here and stays black below.
        const bool valid = rays.valid(first + p, row);
        for (int s = 0; s < kSamplesPerPixel; ++s) {
          const Vec2d within = kSamples[static_cast<std::size_t>(s)];
          const Vec3d in_camera = valid ? rays.direction(first + p, row, within) : Vec3d{0, 0, 1};
          batch[static_cast<std::size_t>(p * kSamplesPerPixel + s)] = {pose.center, world_from_cam * in_camera};
        }
      }
      world.look(batch.data(), pixels * kSamplesPerPixel, hits.data(), light.data());
      for (int p = 0; p < pixels; ++p) {
        if (!rays.valid(first + p, row)) continue;
        LinearRgb sum;
        for (int s = 0; s < kSamplesPerPixel; ++s)
          sum = sum + light[static_cast<std::size_t>(p * kSamplesPerPixel + s)];
        photo(first + p, row) = expose(1.f / kSamplesPerPixel * sum, exposure, first + p, row);
      }
    }
  });
  return photo;
}

}  // namespace skysweep::scene
