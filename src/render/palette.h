// SPDX-License-Identifier: Apache-2.0
// Colours that stand for numbers.
#pragma once

#include <vector>

#include "core/vec.h"

namespace skysweep::render {

// Red, green and blue from 0 to 255.
class Palette {
 public:
  // `stops` from the lowest to the highest number, evenly spaced; at least two.
  explicit Palette(std::vector<Vec3d> stops) : stops_(std::move(stops)) {}
  // `share` from 0 (lowest) to 1 (highest); what lies outside gets the colour of the end.
  Vec3d at(double share) const;

 private:
  std::vector<Vec3d> stops_;
};

const Palette& relief_palette();      // green, yellow, brown, white
const Palette& slope_palette();       // white, yellow, red, dark
const Palette& confidence_palette();  // green (certain), yellow, red
const Palette& count_palette();       // dark blue, green, yellow
// Neighbouring levels differ plainly; repeats after eight.
Vec3d level_color(int level);

}  // namespace skysweep::render
