// SPDX-License-Identifier: Apache-2.0
#include "app/commands/render/picture_file.h"

#include <cmath>
#include <cstdio>

#include "raster/atomic_file.h"
#include "raster/exr.h"
#include "raster/picture.h"

namespace skysweep::app {
namespace {

// sRGB (IEC 61966-2-1) to linear light.
float linear(std::uint8_t value) {
  const double v = value / 255.0;
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

}  // namespace

void write_picture(const std::filesystem::path& path, PictureKind kind, int quality, const Array2d<Rgb8>& picture) {
  if (kind == PictureKind::png) return raster::write_bytes_atomically(path, raster::png_bytes(picture));
  Array2d<Rgba8> opaque(picture.width(), picture.height());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const Rgb8 c = picture.data()[i];
    opaque.data()[i] = {c.r, c.g, c.b, 255};
  }
  const raster::PictureFormat format =
      kind == PictureKind::jpeg ? raster::PictureFormat::jpeg : raster::PictureFormat::webp;
  raster::write_bytes_atomically(path, raster::picture_bytes(opaque, format, quality));
}

void write_layers(const std::filesystem::path& path, const Array2d<Rgb8>& picture, const render::PictureLayers& layers,
                  std::map<std::string, std::string> labels) {
  Array2d<float> red(picture.width(), picture.height()), green = red, blue = red;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const Rgb8 c = picture.data()[i];
    red.data()[i] = linear(c.r), green.data()[i] = linear(c.g), blue.data()[i] = linear(c.b);
  }
  char origin[120];
  std::snprintf(origin, sizeof origin, "%.6f %.6f %.6f", layers.origin.x, layers.origin.y, layers.origin.z);
  labels["origin"] = origin;
  raster::write_exr(path, {{{"R", red},
                            {"G", green},
                            {"B", blue},
                            {"Z", layers.distance_m},
                            {"position.X", layers.x_m},
                            {"position.Y", layers.y_m},
                            {"position.Z", layers.z_m},
                            {"normal.X", layers.normal_x},
                            {"normal.Y", layers.normal_y},
                            {"normal.Z", layers.normal_z},
                            {"level", layers.level}},
                           std::move(labels)});
}

}  // namespace skysweep::app
