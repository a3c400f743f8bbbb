// SPDX-License-Identifier: Apache-2.0
// What a web tile looks like as bytes: pictures, heights packed into the colours of a PNG, or floats.
#pragma once

#include <string>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"

namespace skysweep::exports {

enum class TileEncoding {
  png,          // RGBA
  webp,         // RGBA; lossless with quality 100
  jpeg,         // RGB: no-data is white
  terrarium,    // PNG; height = R 256 + G + B / 256 - 32768: steps of 4 mm
  terrain_rgb,  // PNG; height = (R 65536 + G 256 + B) / 10 - 10000: steps of 0.1 m
  float32,      // GeoTIFF, no-data NaN
};

// "png", "webp", "jpeg", "terrarium", "terrain-rgb", "float32" in the order of the enumeration.
const std::vector<std::string>& encoding_names();
bool is_picture(TileEncoding encoding);
// Of the tile's files, without the dot.
std::string extension_of(TileEncoding encoding);

// Heights in metres packed into colours, NaN as four zeros. Heights outside of what the encoding reaches become its
// lowest or highest.
Array2d<Rgba8> packed_heights(const Array2d<float>& heights, TileEncoding encoding);

// The tile of the next coarser zoom (or a quarter of it): 2 x 2 cells become one, their mean without no-data.
Array2d<float> halved(const Array2d<float>& cells);
// Colours weighted by alpha; alpha is the mean of all four.
Array2d<Rgba8> halved(const Array2d<Rgba8>& cells);

}  // namespace skysweep::exports
