// SPDX-License-Identifier: Apache-2.0
// Linear light of red, green and blue.
#pragma once

namespace skysweep::scene {

struct LinearRgb {
  float r = 0, g = 0, b = 0;
};
inline LinearRgb operator*(float s, LinearRgb c) { return {s * c.r, s * c.g, s * c.b}; }
inline LinearRgb operator+(LinearRgb a, LinearRgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }

}  // namespace skysweep::scene
