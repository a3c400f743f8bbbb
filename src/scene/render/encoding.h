// SPDX-License-Identifier: Apache-2.0
// From linear light to the sRGB grey levels of files (IEC 61966-2-1).
#pragma once

#include <cstdint>
#include <vector>

namespace skysweep::scene {

// Grey level, 0 to 255 and not rounded, of linear light; below 0 and above 1 are clipped.
float srgb_level(float linear);

// Rounded; what lies outside 0 to 255 is clipped.
std::uint8_t to_byte(float level);

}  // namespace skysweep::scene
