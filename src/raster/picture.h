// SPDX-License-Identifier: Apache-2.0
// Pictures made by ourselves, in memory: text on them, and their bytes as a file (through OpenCV).
#pragma once

#include <string>

#include "core/array2d.h"
#include "core/color.h"

namespace skysweep::raster {

// Writes one line of printable ASCII, its baseline starting at pixel (x, y); capitals are about `height_px` high. What
// leaves the image is cut off.
void draw_text(Array2d<Rgb8>& image, int x, int y, const std::string& text, double height_px, Rgb8 color);

// Width of such a line in pixels.
int text_width_px(const std::string& text, double height_px);

enum class PictureFormat {
  png,
  webp,  // lossless with quality 100
  jpeg,  // leaves alpha out
};

// The bytes of such a file; `quality`, 1 to 100, counts for webp and jpeg.
std::string picture_bytes(const Array2d<Rgba8>& image, PictureFormat format, int quality);

// The bytes of a PNG file; the image must not be empty.
std::string png_bytes(const Array2d<Rgb8>& image);

}  // namespace skysweep::raster
