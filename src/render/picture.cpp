// SPDX-License-Identifier: Apache-2.0
#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace skysweep::render {
namespace {

constexpr std::size_t kRaysABand = 1 << 19;  // bounds what a picture needs beside itself

// The rays of some rows, pixel by pixel; those without a direction (beyond a lens model) are left out of the tracing.
struct Band {
  std::vector<Ray> rays;
  std::vector<Vec2d> places;    // in the picture
  std::vector<char> looks_out;  // whether there is a ray
};

Band rays_of_rows(const View& view, int first_row, int rows, int samples, Executor& executor) {
  const int width = view.size().width_px, a_row = width * samples * samples;
  Band band;
  band.rays.resize(static_cast<std::size_t>(rows) * a_row);
  band.places.resize(band.rays.size());
  band.looks_out.assign(band.rays.size(), 0);
  executor.parallel_for(rows, [&](int row) {
    std::size_t i = static_cast<std::size_t>(row) * a_row;
    for (int x = 0; x < width; ++x)
      for (int sy = 0; sy < samples; ++sy)
        for (int sx = 0; sx < samples; ++sx, ++i) {
          band.places[i] = {x + (sx + 0.5) / samples, first_row + row + (sy + 0.5) / samples};
          if (const std::optional<Ray> ray = view.ray(band.places[i])) band.rays[i] = *ray, band.looks_out[i] = 1;
        }
  });
  return band;
}

// A ray that meets nothing, for where there is none.
std::vector<Hit> hits_of(Band& band, Tracer& tracer, const TraceOptions& options) {
  for (std::size_t i = 0; i < band.rays.size(); ++i)
    if (!band.looks_out[i]) band.rays[i] = {{0, 0, 1e30}, {0, 0, 1}};
  return tracer.first_hits(band.rays, options);
}

std::vector<char> shadows_of(const Band& band, const std::vector<Hit>& hits, const Shading& shading, Tracer& tracer) {
  std::vector<char> shadowed(hits.size(), 0);
  std::vector<Ray> rays;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i].any())
      if (const std::optional<Ray> ray = shading.shadow_ray(band.rays[i], hits[i]))
        rays.push_back(*ray), of.push_back(i);
  const std::vector<Hit> blockers = tracer.first_hits(rays, {});
  for (std::size_t i = 0; i < of.size(); ++i) shadowed[of[i]] = blockers[i].any() && !blockers[i].from_below;
  return shadowed;
}

std::uint8_t to_byte(double v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0))); }

}  // namespace

Array2d<Rgb8> draw_picture(const View& view, const Shading& shading, const LookOptions& look,
                           const PictureOptions& options, Tracer& tracer, Executor& executor, const OnBand& on_band) {
  const PictureSize size = view.size();
  const int per_pixel = options.samples * options.samples;
  const int band_rows =
      std::max(1, static_cast<int>(kRaysABand / (static_cast<std::size_t>(size.width_px) * per_pixel)));
  TraceOptions trace;
  if (options.level_of_detail)
    trace.pixel = {view.pixel().fixed_m / options.samples, view.pixel().per_metre / options.samples};
  Array2d<Rgb8> picture(size.width_px, size.height_px, look.background);
  for (int first = 0; first < size.height_px; first += band_rows) {
    const int rows = std::min(band_rows, size.height_px - first);
    Band band = rays_of_rows(view, first, rows, options.samples, executor);
    const std::vector<Hit> hits = hits_of(band, tracer, trace);
    const std::vector<char> shadowed =
        look.shadows ? shadows_of(band, hits, shading, tracer) : std::vector<char>(hits.size(), 0);
    executor.parallel_for(rows, [&](int row) {
      std::size_t i = static_cast<std::size_t>(row) * size.width_px * per_pixel;
      for (int x = 0; x < size.width_px; ++x) {
        Vec3d sum;
        for (int s = 0; s < per_pixel; ++s, ++i)
          sum = sum + shading.color(band.rays[i], hits[i], shadowed[i] != 0, band.places[i]);
        picture(x, first + row) = {to_byte(sum.x / per_pixel), to_byte(sum.y / per_pixel), to_byte(sum.z / per_pixel)};
      }
    });
    if (on_band && !on_band(1. * (first + rows) / size.height_px)) break;
  }
  return picture;
}

PictureLayers draw_layers(const View& view, const Shading& shading, Vec3d origin, Tracer& tracer, Executor& executor) {
  const int width = view.size().width_px, height = view.size().height_px;
  const Array2d<float> none(width, height, std::numeric_limits<float>::quiet_NaN());
  PictureLayers out{none, none, none, none, none, none, none, none, origin};
  const int band_rows = std::max(1, static_cast<int>(kRaysABand / static_cast<std::size_t>(width)));
  for (int first = 0; first < height; first += band_rows) {
    const int rows = std::min(band_rows, height - first);
    Band band = rays_of_rows(view, first, rows, 1, executor);
    const std::vector<Hit> hits = hits_of(band, tracer, {view.pixel(), true});
    executor.parallel_for(rows, [&](int row) {
      for (int x = 0; x < width; ++x) {
        const std::size_t i = static_cast<std::size_t>(row) * width + x;
        if (!hits[i].any()) continue;
        const int y = first + row;
        const Vec3d place = along(band.rays[i], hits[i].distance_m) - origin;
        const Vec3d normal = shading.normal(band.rays[i], hits[i]);
        out.distance_m(x, y) = static_cast<float>(hits[i].distance_m);
        out.x_m(x, y) = static_cast<float>(place.x), out.y_m(x, y) = static_cast<float>(place.y);
        out.z_m(x, y) = static_cast<float>(place.z);
        out.normal_x(x, y) = static_cast<float>(normal.x), out.normal_y(x, y) = static_cast<float>(normal.y);
        out.normal_z(x, y) = static_cast<float>(normal.z);
        out.level(x, y) = static_cast<float>(hits[i].level);
      }
    });
  }
  return out;
}

}  // namespace skysweep::render
