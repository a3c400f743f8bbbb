// SPDX-License-Identifier: Apache-2.0
#include "raster/hillshade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace skysweep::raster {
namespace {

Vec3d towards_sun(const HillshadeOptions& options) {
  const double azimuth = options.sun_azimuth_deg * std::numbers::pi / 180;
  const double elevation = options.sun_elevation_deg * std::numbers::pi / 180;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

// Upward normal of the surface at a cell that has a height.
Vec3d normal(const Raster<float>& dem, int column, int row, double exaggeration) {
  const double own = dem.values(column, row);
  const auto z = [&](int dx, int dy) -> double {
    const int x = column + dx, y = row + dy;
    return dem.values.contains(x, y) && std::isfinite(dem.values(x, y)) ? dem.values(x, y) : own;
  };
  const double scale = exaggeration / (8 * dem.georeference.cell_m);
  const double east = scale * (z(1, -1) + 2 * z(1, 0) + z(1, 1) - z(-1, -1) - 2 * z(-1, 0) - z(-1, 1));
  const double north = scale * (z(-1, -1) + 2 * z(0, -1) + z(1, -1) - z(-1, 1) - 2 * z(0, 1) - z(1, 1));
  return normalized(Vec3d{-east, -north, 1});
}

Rgb8 no_height(int column, int row) {
  const std::uint8_t grey = ((column / 8 + row / 8) % 2) ? 235 : 220;
  return {grey, grey, grey};
}

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l)); }

// color(column, row) gives the fully lit colour, 0 to 255, of a cell.
template <typename Color>
Array2d<Rgb8> shade(const Raster<float>& dem, const HillshadeOptions& options, Color color) {
  const Vec3d sun = towards_sun(options);
  Array2d<Rgb8> out(dem.values.width(), dem.values.height());
  for (int row = 0; row < out.height(); ++row)
    for (int column = 0; column < out.width(); ++column) {
      if (!std::isfinite(dem.values(column, row))) {
        out(column, row) = no_height(column, row);
        continue;
      }
      const double light = std::max(0.0, dot(normal(dem, column, row, options.exaggeration), sun));
      const Vec3d lit = light * color(column, row);
      out(column, row) = {to_byte(lit.x), to_byte(lit.y), to_byte(lit.z)};
    }
  return out;
}

// `height` from 0 (low) to 1 (high).
Vec3d relief_color(double height) {
  static constexpr std::array<Vec3d, 5> kStops = {
      {{86, 150, 110}, {170, 200, 130}, {235, 220, 150}, {190, 140, 100}, {250, 250, 250}}};
  const double position = std::clamp(height, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(position), kStops.size() - 2);
  const double t = position - static_cast<double>(low);
  return (1 - t) * kStops[low] + t * kStops[low + 1];
}

}  // namespace

Array2d<Rgb8> hillshade(const Raster<float>& dem, const HillshadeOptions& options) {
  return shade(dem, options, [](int, int) { return Vec3d{255, 255, 255}; });
}

HeightSpan usual_span(std::vector<float>& heights_m) {
  if (heights_m.empty()) return {};
  const auto quantile = [&](double q) -> double {
    const auto rank = static_cast<std::ptrdiff_t>(q * static_cast<double>(heights_m.size() - 1));
    std::nth_element(heights_m.begin(), heights_m.begin() + rank, heights_m.end());
    return heights_m[static_cast<std::size_t>(rank)];
  };
  const double low = quantile(0.02);
  return {low, quantile(0.98)};
}

Array2d<Rgb8> shaded_relief(const Raster<float>& dem, HeightSpan span, const HillshadeOptions& options) {
  // Level ground lit at 45 degrees should show its colour nearly as it is, not at 70 %.
  constexpr double kBrightness = 1.3;
  const double width = span.high_m - span.low_m;
  return shade(dem, options, [&](int column, int row) {
    return kBrightness * relief_color(width > 0 ? (dem.values(column, row) - span.low_m) / width : 0.5);
  });
}

}  // namespace skysweep::raster
