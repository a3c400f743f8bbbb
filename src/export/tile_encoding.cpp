// SPDX-License-Identifier: Apache-2.0
#include "export/tile_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/check.h"

namespace skysweep::exports {

const std::vector<std::string>& encoding_names() {
  static const std::vector<std::string> names = {"png", "webp", "jpeg", "terrarium", "terrain-rgb", "float32"};
  return names;
}

bool is_picture(TileEncoding encoding) {
  return encoding == TileEncoding::png || encoding == TileEncoding::webp || encoding == TileEncoding::jpeg;
}

std::string extension_of(TileEncoding encoding) {
  switch (encoding) {
    case TileEncoding::webp: return "webp";
    case TileEncoding::jpeg: return "jpg";
    case TileEncoding::float32: return "tif";
    default: return "png";
  }
}

Array2d<Rgba8> packed_heights(const Array2d<float>& heights, TileEncoding encoding) {
  SKY_CHECK(encoding == TileEncoding::terrarium || encoding == TileEncoding::terrain_rgb);
  const bool terrarium = encoding == TileEncoding::terrarium;
  const double lowest = terrarium ? -32768 : -10000, steps_per_metre = terrarium ? 256 : 10;
  constexpr double kLargest = (1 << 24) - 1;
  Array2d<Rgba8> out(heights.width(), heights.height());
  std::transform(heights.begin(), heights.end(), out.begin(), [&](float height) -> Rgba8 {
    if (!std::isfinite(height)) return {};
    const double steps = std::clamp(std::round((height - lowest) * steps_per_metre), 0.0, kLargest);
    const auto n = static_cast<std::uint32_t>(steps);
    return {static_cast<std::uint8_t>(n >> 16), static_cast<std::uint8_t>(n >> 8), static_cast<std::uint8_t>(n), 255};
  });
  return out;
}

Array2d<float> halved(const Array2d<float>& cells) {
  Array2d<float> out(cells.width() / 2, cells.height() / 2);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      double sum = 0;
      int known = 0;
      for (const float z :
           {cells(2 * x, 2 * y), cells(2 * x + 1, 2 * y), cells(2 * x, 2 * y + 1), cells(2 * x + 1, 2 * y + 1)}) {
        if (!std::isfinite(z)) continue;
        sum += z;
        ++known;
      }
      out(x, y) = known ? static_cast<float>(sum / known) : std::numeric_limits<float>::quiet_NaN();
    }
  return out;
}

Array2d<Rgba8> halved(const Array2d<Rgba8>& cells) {
  Array2d<Rgba8> out(cells.width() / 2, cells.height() / 2);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      int r = 0, g = 0, b = 0, a = 0;
      for (const Rgba8 c :
           {cells(2 * x, 2 * y), cells(2 * x + 1, 2 * y), cells(2 * x, 2 * y + 1), cells(2 * x + 1, 2 * y + 1)}) {
        r += c.r * c.a;
        g += c.g * c.a;
        b += c.b * c.a;
        a += c.a;
      }
      if (a == 0) continue;
      const auto mean = [&](int sum) { return static_cast<std::uint8_t>((sum + a / 2) / a); };
      out(x, y) = {mean(r), mean(g), mean(b), static_cast<std::uint8_t>((a + 2) / 4)};
    }
  return out;
}

}  // namespace skysweep::exports
