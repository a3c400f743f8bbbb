// SPDX-License-Identifier: Apache-2.0
#include "sweep/image_pyramid.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "sweep/local_normalization.h"
#include "sweep/similar_normalization.h"

namespace skysweep::sweep {
namespace {

Array2d<std::uint16_t> luminance_of(const Array2d<Rgb8>& photograph) {
  Array2d<std::uint16_t> out(photograph.width(), photograph.height());
  std::transform(photograph.begin(), photograph.end(), out.begin(), [](Rgb8 p) {
    const double grey = 0.212671 * p.r + 0.715160 * p.g + 0.072169 * p.b;
    return static_cast<std::uint16_t>(grey * kLuminanceScale + 0.5);
  });
  return out;
}

constexpr int half(int size) { return (size + 1) / 2; }

// Calls combine(a, b, c, d) with the four pixels below each pixel of the next level; the last row or column of an odd
// size is repeated.
template <typename T, typename Combine>
Array2d<T> halve(const Array2d<T>& fine, Combine combine) {
  Array2d<T> coarse(half(fine.width()), half(fine.height()));
  for (int y = 0; y < coarse.height(); ++y) {
    const T* upper = fine.row(2 * y);
    const T* lower = fine.row(std::min(2 * y + 1, fine.height() - 1));
    for (int x = 0; x < coarse.width(); ++x) {
      const int left = 2 * x, right = std::min(2 * x + 1, fine.width() - 1);
      coarse(x, y) = combine(upper[left], upper[right], lower[left], lower[right]);
    }
  }
  return coarse;
}

constexpr unsigned rounded_mean(unsigned a, unsigned b, unsigned c, unsigned d) { return (a + b + c + d + 2) / 4; }

LuminanceLevel prepared(Array2d<std::uint16_t> inner, Normalization normalization) {
  if (normalization.radius_px > 0 && normalization.tolerance > 0)
    normalize_similar(inner, normalization.radius_px, normalization.tolerance * static_cast<int>(kLuminanceScale));
  else if (normalization.radius_px > 0)
    normalize_locally(inner, normalization.radius_px);
  LuminanceLevel level{inner.width(), inner.height(), inner.width() + 2, {}};
  level.pairs.resize(static_cast<std::size_t>(level.stride) * (level.height + 2));
  for (int y = -1; y <= level.height; ++y) {
    const std::uint16_t* from = inner.row(std::clamp(y, 0, level.height - 1));
    const std::uint16_t* below = inner.row(std::clamp(y + 1, 0, level.height - 1));
    std::uint32_t* to = level.pairs.data() + static_cast<std::size_t>(y + 1) * level.stride;
    for (int x = 0; x < level.width; ++x) to[x + 1] = from[x] | static_cast<std::uint32_t>(below[x]) << 16;
    to[0] = to[1];
    to[level.width + 1] = to[level.width];
  }
  return level;
}

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

Array2d<std::uint16_t> LuminanceLevel::pixels_with_border() const {
  Array2d<std::uint16_t> pixels(width + 2, height + 2);
  std::transform(pairs.begin(), pairs.end(), pixels.begin(), [](std::uint32_t pair) { return pair & 0xFFFF; });
  return pixels;
}

ImagePyramid::ImagePyramid(Array2d<Rgb8> photograph, Normalization normalization) : id_(next_id()) {
  SKY_CHECK(!photograph.empty());
  Array2d<std::uint16_t> grey = luminance_of(photograph);
  color_.push_back(std::move(photograph));
  luminance_.push_back(prepared(grey, normalization));
  while (grey.width() > 1 || grey.height() > 1) {
    grey = halve(grey,
                 [](auto a, auto b, auto c, auto d) { return static_cast<std::uint16_t>(rounded_mean(a, b, c, d)); });
    luminance_.push_back(prepared(grey, normalization));
    color_.push_back(halve(color_.back(), [](Rgb8 a, Rgb8 b, Rgb8 c, Rgb8 d) {
      return Rgb8{static_cast<std::uint8_t>(rounded_mean(a.r, b.r, c.r, d.r)),
                  static_cast<std::uint8_t>(rounded_mean(a.g, b.g, c.g, d.g)),
                  static_cast<std::uint8_t>(rounded_mean(a.b, b.b, c.b, d.b))};
    }));
  }
}

std::size_t ImagePyramid::bytes_for(int width_px, int height_px) {
  std::size_t bytes = 0;
  for (int w = width_px, h = height_px;; w = half(w), h = half(h)) {
    bytes += sizeof(std::uint32_t) * (w + 2) * (h + 2) + sizeof(Rgb8) * w * h;
    if (w <= 1 && h <= 1) return bytes;
  }
}

Rgb8 ImagePyramid::sample_color(Vec2d pixel, int level) const {
  const Array2d<Rgb8>& image = color_[level];
  const double scale = std::ldexp(1.0, -level);
  const Tap x = tap_at(pixel.x * scale, image.width());
  const Tap y = tap_at(pixel.y * scale, image.height());
  const auto at = [&](int column, int row) {
    return image(std::clamp(column, 0, image.width() - 1), std::clamp(row, 0, image.height() - 1));
  };
  const Rgb8 nw = at(x.index, y.index), ne = at(x.index + 1, y.index);
  const Rgb8 sw = at(x.index, y.index + 1), se = at(x.index + 1, y.index + 1);
  const auto blend = [&](double a, double b, double c, double d) {
    return static_cast<std::uint8_t>(mix(mix(a, b, x.weight), mix(c, d, x.weight), y.weight) + 0.5);
  };
  return {blend(nw.r, ne.r, sw.r, se.r), blend(nw.g, ne.g, sw.g, se.g), blend(nw.b, ne.b, sw.b, se.b)};
}

}  // namespace skysweep::sweep
