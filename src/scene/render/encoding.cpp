// SPDX-License-Identifier: Apache-2.0
#include "scene/render/encoding.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skysweep::scene {
namespace {

constexpr int kEntries = 8192;

// The curve at i / kEntries; one entry more for interpolation at 1.
std::array<float, kEntries + 2> make_table() {
  std::array<float, kEntries + 2> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double v = std::min(1.0, static_cast<double>(i) / kEntries);
    table[i] = static_cast<float>(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055));
  }
  return table;
}

}  // namespace

float srgb_level(float linear) {
  static const std::array<float, kEntries + 2> table = make_table();
  const float position = std::clamp(linear, 0.f, 1.f) * kEntries;
  const auto i = static_cast<std::size_t>(position);
  return table[i] + (position - static_cast<float>(i)) * (table[i + 1] - table[i]);
}

std::uint8_t to_byte(float level) { return static_cast<std::uint8_t>(std::clamp(level, 0.f, 255.f) + 0.5f); }

}  // namespace skysweep::scene
