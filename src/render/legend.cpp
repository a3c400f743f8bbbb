// SPDX-License-Identifier: Apache-2.0
#include "render/legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "raster/picture.h"

namespace skysweep::render {
namespace {

constexpr int kWidth = 200, kHeight = 58, kEdge = 12, kPad = 10, kBarHeight = 12, kTextPx = 10;
constexpr Rgb8 kPaper{252, 252, 252}, kInk{40, 40, 45};

Rgb8 rounded(Vec3d c) {
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0))); };
  return {byte(c.x), byte(c.y), byte(c.z)};
}

// At a share of the scale, with as many digits as its span needs.
std::string number_text(const Scale& scale, double share) {
  const double span = scale.high - scale.low, value = scale.low + share * span;
  if (scale.whole) return std::to_string(static_cast<int>(value));
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", span >= 20 ? 0 : span >= 2 ? 1 : span >= 0.2 ? 2 : 3, value);
  return text;
}

void draw_panel(Array2d<Rgb8>& picture, int left, int top) {
  for (int y = top; y < top + kHeight; ++y)
    for (int x = left; x < left + kWidth; ++x) picture(x, y) = kPaper;
}

void draw_bar(const Scale& scale, Array2d<Rgb8>& picture, int left, int top, int width) {
  for (int x = 0; x < width; ++x) {
    const double share = (x + 0.5) / width;
    const Rgb8 color = rounded(scale.palette ? scale.palette->at(share) : level_color(static_cast<int>(share * 8)));
    for (int y = 0; y < kBarHeight; ++y) picture(left + x, top + y) = color;
  }
}

}  // namespace

void draw_legend(const Scale& scale, Array2d<Rgb8>& picture) {
  if (picture.width() < kWidth + 2 * kEdge || picture.height() < kHeight + 2 * kEdge) return;
  const int left = kEdge, top = picture.height() - kEdge - kHeight, bar = kWidth - 2 * kPad;
  draw_panel(picture, left, top);
  raster::draw_text(picture, left + kPad, top + kPad + kTextPx - 2, scale.title, kTextPx, kInk);
  draw_bar(scale, picture, left + kPad, top + 22, bar);
  const int baseline = top + kHeight - 9;
  for (const double share : {0.0, 0.5, 1.0}) {
    const std::string text = number_text(scale, share);
    const int width = raster::text_width_px(text, kTextPx);
    const int x = left + kPad + static_cast<int>(share * bar) - static_cast<int>(share * width);
    raster::draw_text(picture, x, baseline, text, kTextPx, kInk);
  }
}

}  // namespace skysweep::render
