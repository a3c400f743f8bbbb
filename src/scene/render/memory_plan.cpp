// SPDX-License-Identifier: Apache-2.0
#include "scene/render/memory_plan.h"

#include <algorithm>

namespace skysweep::scene {
namespace {

// GDAL with its block cache of 64 MiB (raster/gdal/session.cpp), OpenCV and their threads.
constexpr std::uint64_t kLibraries = 96ull << 20;

}  // namespace

std::uint64_t planned_bytes(const Scene& scene, const TruthGrid& grid) {
  const auto count = [](int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  const std::uint64_t pixels = count(scene.camera.width_px, scene.camera.height_px),
                      cells = count(grid.width, grid.height);
  const bool light = scene.photographs.format == PhotoFormat::exr;
  // Two in memory, one copy for the encoder, and as much again for what it writes.
  const std::uint64_t of_photograph = 4 * (light ? sizeof(LinearRgb) : sizeof(Rgb8));
  const std::uint64_t of_depth = scene.truth.depth ? 4 * sizeof(float) : 0;
  // The layers (surface, ground, colour, views, classes), and one of them once more while it is written.
  const std::uint64_t of_truth = 2 * sizeof(float) + sizeof(Rgba8) + 2 * sizeof(std::uint8_t) + sizeof(float);
  return kLibraries + std::max(pixels * (of_photograph + of_depth), cells * of_truth);
}

}  // namespace skysweep::scene
