// SPDX-License-Identifier: Apache-2.0
#include "report/difference_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/check.h"
#include "core/vec.h"
#include "raster/picture.h"

namespace skysweep::report {
namespace {

constexpr Rgb8 kWhite{255, 255, 255}, kInk{30, 30, 30}, kNoTruth{96, 96, 96};
constexpr int kSmallestMapPx = 480;  // maps of fewer cells are magnified
constexpr double kTextPx = 11;

// Diagonal stripes: no colour of the scale looks like them.
Rgb8 hatch(int x, int y) { return (x + y) % 8 < 3 ? Rgb8{40, 40, 40} : Rgb8{205, 205, 205}; }

// One pixel of the map: the mean of the known dz of a square of cells.
struct Patch {
  double dz_sum = 0;
  int dz_count = 0, truth_count = 0;
};

Patch patch_at(const HeightDifferences& cells, int column, int row, int side) {
  Patch patch;
  for (int y = row; y < std::min(row + side, cells.dz.height()); ++y)
    for (int x = column; x < std::min(column + side, cells.dz.width()); ++x) {
      patch.truth_count += !std::isnan(cells.truth(x, y));
      if (const float dz = cells.dz(x, y); !std::isnan(dz)) patch.dz_sum += dz, ++patch.dz_count;
    }
  return patch;
}

struct Scale {
  int thinning = 1;  // cells per pixel
  int zoom = 1;      // pixels per cell
};

Scale scale_of(int width, int height, int largest_side_px) {
  const int side = std::max(width, height);
  if (largest_side_px > 0 && side > largest_side_px) return {(side + largest_side_px - 1) / largest_side_px, 1};
  return {1, std::max(1, kSmallestMapPx / side)};
}

void fill(Array2d<Rgb8>& image, int x, int y, int width, int height, Rgb8 color) {
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) image(column, row) = color;
}

std::string metres(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, value == 0 ? "0" : "%+.4g", value);
  return buffer;
}

constexpr int kLegendWidth = 460, kLegendHeight = 92;

void draw_legend(Array2d<Rgb8>& image, int top, double limit_m) {
  constexpr int kLeft = 40, kBarWidth = 380, kBarHeight = 16;
  const auto write = [&](int x, int y, const std::string& text) {
    raster::draw_text(image, x, y, text, kTextPx, kInk);
  };
  write(kLeft, top + 18, "dz = measured - true height, metres");
  const int bar = top + 26;
  for (int i = 0; i < kBarWidth; ++i)
    fill(image, kLeft + i, bar, 1, kBarHeight, difference_color(2 * (i + 0.5) / kBarWidth - 1));
  for (int tick = -2; tick <= 2; ++tick) {
    const int x = kLeft + (tick + 2) * kBarWidth / 4;
    fill(image, x, bar + kBarHeight, 1, 4, kInk);
    const std::string label = metres(limit_m * tick / 2);
    write(x - raster::text_width_px(label, kTextPx) / 2, bar + kBarHeight + 17, label);
  }
  const int boxes = top + 70;
  for (int y = boxes; y < boxes + 14; ++y)
    for (int x = kLeft; x < kLeft + 24; ++x) image(x, y) = hatch(x, y);
  write(kLeft + 32, boxes + 12, "no measured height");
  fill(image, kLeft + 210, boxes, 24, 14, kNoTruth);
  write(kLeft + 242, boxes + 12, "no true height");
}

}  // namespace

Rgb8 difference_color(double dz_in_limits) {
  static constexpr std::array<Vec3d, 5> kStops = {
      {{18, 52, 130}, {105, 160, 215}, {246, 246, 246}, {233, 135, 95}, {145, 16, 28}}};
  const double position = (std::clamp(dz_in_limits, -1.0, 1.0) + 1) / 2 * (kStops.size() - 1);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(position), kStops.size() - 2);
  const double t = position - static_cast<double>(low);
  const Vec3d color = (1 - t) * kStops[low] + t * kStops[low + 1];
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {byte(color.x), byte(color.y), byte(color.z)};
}

Array2d<Rgb8> difference_map(const HeightDifferences& cells, const DifferenceMapOptions& options) {
  SKY_CHECK(!cells.dz.empty());
  SKY_CHECK(options.limit_m > 0);
  const Scale scale = scale_of(cells.dz.width(), cells.dz.height(), options.largest_side_px);
  const auto pixels = [&](int count) { return (count + scale.thinning - 1) / scale.thinning * scale.zoom; };
  const int width = pixels(cells.dz.width()), height = pixels(cells.dz.height());
  Array2d<Rgb8> image(std::max(width, kLegendWidth), height + kLegendHeight, kWhite);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Patch patch =
          patch_at(cells, x / scale.zoom * scale.thinning, y / scale.zoom * scale.thinning, scale.thinning);
      if (patch.truth_count == 0)
        image(x, y) = kNoTruth;
      else if (2 * patch.dz_count < patch.truth_count || patch.dz_count == 0)
        image(x, y) = hatch(x, y);
      else
        image(x, y) = difference_color(patch.dz_sum / patch.dz_count / options.limit_m);
    }
  draw_legend(image, height, options.limit_m);
  return image;
}

}  // namespace skysweep::report
