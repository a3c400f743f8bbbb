// SPDX-License-Identifier: Apache-2.0
// 8-bit colours as they lie in photographs and orthophotos (sRGB-encoded, not linear).
#pragma once

#include <cstdint>

namespace skysweep {

struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(const Rgb8&, const Rgb8&) = default;
};

// Alpha 0 = no colour known, 255 = colour known.
struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 0;
  friend constexpr bool operator==(const Rgba8&, const Rgba8&) = default;
};

}  // namespace skysweep
