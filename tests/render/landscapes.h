// SPDX-License-Identifier: Apache-2.0
// Height fields with what is hard for a ray caster: slopes, steps, spikes of one cell, holes, a notch in the border.
#pragma once

#include <cmath>
#include <limits>
#include <memory>

#include "render/height_field.h"

namespace skysweep::render {

inline constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// 39 x 34 cells of 0.5 m; `corner` is the outer north-west one.
inline std::shared_ptr<const HeightField> hard_landscape(Vec2d corner) {
  Array2d<float> height(39, 34);
  for (int y = 0; y < 34; ++y)
    for (int x = 0; x < 39; ++x) {
      double h = 1.2 * std::sin(x / 4.0) + 0.9 * std::cos(y / 3.0) + 0.02 * x;
      if (x >= 20 && x < 29 && y >= 8 && y < 16) h = 5;                               // a house
      if ((x == 7 && y == 7) || (x == 9 && y == 20) || (x == 31 && y == 25)) h += 6;  // spikes
      if (x == 15 && y == 27) h -= 4;                                                 // a well
      height(x, y) = static_cast<float>(h);
    }
  for (int y = 20; y < 25; ++y)
    for (int x = 14; x < 19; ++x) height(x, y) = kNothing;  // a hole
  height(30, 5) = kNothing;                                 // a hole of one cell
  for (int y = 28; y < 34; ++y)
    for (int x = 24; x < 28; ++x) height(x, y) = kNothing;  // a notch
  return std::make_shared<HeightField>(make_height_field(corner, 0.5, height));
}

}  // namespace skysweep::render
