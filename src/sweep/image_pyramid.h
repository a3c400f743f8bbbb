// SPDX-License-Identifier: Apache-2.0
// A photograph as the sweep reads it: luminance and colour, each with its mipmap levels. Level l halves level l-1 by
// the mean of 2 x 2 pixels, so one of its pixels stands for a window of 2^l x 2^l. Pixel coordinates at level l are
// those of level 0 divided by 2^l (the centre of the top-left pixel is (0.5, 0.5) at every level). Immutable once
// built.
#pragma once

#include <cstdint>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "core/vec.h"

namespace skysweep::sweep {

// Luminance in units of 1/256 grey level (Y = 0.212671 R + 0.715160 G + 0.072169 B), with a border
// of one repeated pixel on every side, so that bilinear sampling anywhere on the photograph reads inside the array.
struct LuminanceLevel {
  int width = 0;  // without the border
  int height = 0;
  int stride = 0;  // elements from one row to the next
  std::vector<std::uint16_t> values;

  // Pixel with 0-based indices; -1 and width (height) address the border.
  std::uint16_t at(int column, int row) const {
    return values[static_cast<std::size_t>(row + 1) * stride + (column + 1)];
  }
};

constexpr double kLuminanceScale = 256;  // stored units per grey level

class ImagePyramid {
 public:
  // `normalization_radius_px`: see SweepOptions; each level is normalised by itself, in its own pixels. 0 keeps the
  // luminance as photographed.
  explicit ImagePyramid(Array2d<Rgb8> photograph, int normalization_radius_px = 0);

  // Tells photographs apart for as long as the program runs; a copy, being equal, has the same.
  std::uint64_t id() const { return id_; }

  int width() const { return color_[0].width(); }
  int height() const { return color_[0].height(); }
  int levels() const { return static_cast<int>(luminance_.size()); }
  const LuminanceLevel& luminance(int level) const { return luminance_[level]; }

  // Bytes this object holds; and what a photograph of a given size will hold.
  std::size_t bytes() const { return bytes_for(width(), height()); }
  static std::size_t bytes_for(int width_px, int height_px);

  // Bilinear samples, in double precision: grey levels 0..255. `pixel` is a position at level 0, on the photograph.
  double sample_luminance(Vec2d pixel, int level) const;
  Rgb8 sample_color(Vec2d pixel, int level) const;

 private:
  std::uint64_t id_;
  std::vector<LuminanceLevel> luminance_;
  std::vector<Array2d<Rgb8>> color_;
};

}  // namespace skysweep::sweep
