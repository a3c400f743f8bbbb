// SPDX-License-Identifier: Apache-2.0
// What a picture of the map shows, and how it is lit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/vec.h"
#include "raster/hillshade.h"
#include "render/palette.h"
#include "render/view.h"

namespace skysweep::render {

enum class Look {
  orthophoto,  // the map's own colours; with a sun or shadows, lit by it as well
  hillshade,   // grey, lit
  relief,      // heights as colours, lit
  slope,       // steepness as colours, of the true surface
  confidence,  // standard deviation of the heights as colours
  views,       // how many photographs have the place in their frame
  level,       // which level of the map and of detail was drawn, in false colours
};
const std::vector<std::string>& look_names();  // in the order of the enumeration

struct Sun {
  double azimuth_deg = 315;  // clockwise from north
  double elevation_deg = 45;
  Vec3d direction() const;  // towards it
};

// Over the left shoulder of who looks at the picture, so that what is turned to them is lit; from the upper left for
// views from above, as on maps: north-west with north at the top.
Sun usual_sun(const View& view);

struct LookOptions {
  Look look = Look::orthophoto;
  std::optional<Sun> sun;                           // without it usual_sun, and none for orthophoto
  bool shadows = false;                             // cast shadows
  std::optional<raster::HeightSpan> relief_span_m;  // heights at the ends of the colours; usually those of the map
  Rgb8 background{226, 232, 238};
  bool legend = true;  // for looks whose colours stand for numbers

  bool is_lit() const { return look != Look::orthophoto || sun || shadows; }
};

// What the colours of a look stand for: numbers from low to high.
struct Scale {
  const Palette* palette = nullptr;  // none: colours of levels
  double low = 0, high = 1;
  std::string title;   // with unit
  bool whole = false;  // whole numbers only
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

}  // namespace skysweep::render
