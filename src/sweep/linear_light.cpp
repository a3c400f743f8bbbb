// SPDX-License-Identifier: Apache-2.0
#include "sweep/linear_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skysweep::sweep {
namespace {

constexpr int kSteps = 4096;  // of the table from light to bytes; between them it is interpolated

double decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

struct Tables {
  std::array<float, 256> light;
  std::array<float, kSteps + 2> bytes;  // one more than the last interval needs
  Tables() {
    for (int i = 0; i < 256; ++i) light[i] = static_cast<float>(decoded(i / 255.0));
    for (int i = 0; i < kSteps + 2; ++i)
      bytes[i] = static_cast<float>(255 * encoded(std::min(1.0, static_cast<double>(i) / kSteps)));
  }
};

const Tables& tables() {
  static const Tables made;
  return made;
}

}  // namespace

float linear_light(std::uint8_t encoded) { return tables().light[encoded]; }

std::uint8_t encoded_light(float linear) {
  const float at = std::clamp(linear, 0.0f, 1.0f) * kSteps;
  const int i = static_cast<int>(at);
  const float* from = tables().bytes.data() + i;
  return static_cast<std::uint8_t>(from[0] + (at - static_cast<float>(i)) * (from[1] - from[0]) + 0.5f);
}

}  // namespace skysweep::sweep
