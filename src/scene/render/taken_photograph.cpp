// SPDX-License-Identifier: Apache-2.0
#include "scene/render/taken_photograph.h"

#include "raster/atomic_file.h"
#include "raster/exr.h"
#include "raster/photo.h"
#include "scene/render/depth_image.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

void write_light(const fs::path& path, const Array2d<LinearRgb>& light, const std::string& software) {
  raster::ExrImage image;
  Array2d<float>&red = image.channels["R"], &green = image.channels["G"], &blue = image.channels["B"];
  red = green = blue = Array2d<float>(light.width(), light.height());
  for (std::size_t i = 0; i < light.size(); ++i) {
    red.data()[i] = light.data()[i].r;
    green.data()[i] = light.data()[i].g;
    blue.data()[i] = light.data()[i].b;
  }
  image.labels = {{"content", "linear light, sRGB primaries"},
                  {"units", "1 is white, lit like level ground in the sun"},
                  {"software", software}};
  raster::write_exr(path, image);
}

void write_depth(const fs::path& path, const Array2d<float>& depth, const std::string& software) {
  raster::ExrImage image;
  image.channels["Z"] = depth;
  image.labels = {{"content", "depth along the view direction at the centre of each pixel; NaN: nothing there"},
                  {"units", "metre"},
                  {"software", software}};
  raster::write_exr(path, image);
}

}  // namespace

TakenPhotograph take(const Scene& scene, const World& world, const PixelRays& rays, const camera::Pose& pose,
                     const Exposure& exposure, const PhotographEffects* effects, Executor& executor) {
  TakenPhotograph out;
  const Sampling sampling{static_cast<float>(scene.photographs.max_error_levels)};
  if (scene.photographs.format == PhotoFormat::exr)
    out.light = take_linear_photograph(world, scene.camera, rays, pose, exposure, executor, effects, sampling);
  else
    out.levels = take_photograph(world, scene.camera, rays, pose, exposure, executor, effects, sampling);
  if (scene.truth.depth) out.depth = depth_image(world, scene.camera, rays, pose, executor);
  return out;
}

void write_taken(const Scene& scene, const TakenPhotograph& photograph, const std::string& name,
                 const formats::PhotoMetadata* metadata, const std::string& software, const fs::path& folder) {
  const fs::path path = folder / "images" / name;
  if (!photograph.light.empty()) {
    write_light(path, photograph.light, software);
  } else {
    std::string bytes = raster::encode_image(path, photograph.levels, scene.photographs.jpeg_quality);
    if (metadata) bytes = formats::with_metadata(bytes, *metadata);
    raster::write_bytes_atomically(path, bytes);
  }
  if (!photograph.depth.empty())
    write_depth(folder / "truth" / "depth" / fs::path(name).replace_extension("exr"), photograph.depth, software);
}

}  // namespace skysweep::scene
