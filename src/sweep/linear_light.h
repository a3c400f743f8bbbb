// SPDX-License-Identifier: Apache-2.0
// Between the sRGB-encoded bytes of photographs and linear light, in which a longer exposure is a factor
// (IEC 61966-2-1).
#pragma once

#include <cstdint>

namespace skysweep::sweep {

// Linear light of a byte: 0 to 1.
float linear_light(std::uint8_t encoded);

// The nearest byte, to a hundredth; light beyond 0 to 1 is clipped.
std::uint8_t encoded_light(float linear);

}  // namespace skysweep::sweep
