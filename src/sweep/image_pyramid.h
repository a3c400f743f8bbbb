// SPDX-License-Identifier: Apache-2.0
// A photograph as the sweep reads it: luminance and colour, each with its mipmap levels. Level l halves level l-1 by
// the mean of 2 x 2 pixels, so one of its pixels stands for a window of 2^l x 2^l. Pixel coordinates at level l are
// those of level 0 divided by 2^l (the centre of the top-left pixel is (0.5, 0.5) at every level). Immutable once
// built.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "core/vec.h"
#include "sweep/normalization.h"

namespace skysweep::sweep {

constexpr double kLuminanceScale = 256;  // stored units per grey level

// Index of the pixel left of (above) a sampling position, and the weight of its right (lower) neighbour.
struct Tap {
  int index;
  double weight;
};
inline Tap tap_at(double position, int size) {
  const double shifted = position - 0.5;
  int floor = static_cast<int>(shifted);
  floor -= shifted < floor;
  return {std::clamp(floor, -1, size - 1), shifted - floor};
}

constexpr double mix(double a, double b, double weight) { return a + weight * (b - a); }

// Luminance in units of 1/256 grey level (Y = 0.212671 R + 0.715160 G + 0.072169 B), with a border
// of one repeated pixel on every side, so that bilinear sampling anywhere on the photograph reads inside the array.
// Every element holds a pixel and, in its high half, the one below it: two neighbouring elements are the four pixels of
// a bilinear sample, read as one 64-bit word.
struct LuminanceLevel {
  int width = 0;  // without the border
  int height = 0;
  int stride = 0;  // elements from one row to the next
  std::vector<std::uint32_t> pairs;

  // Pixel with 0-based indices; -1 and width (height) address the border.
  std::uint16_t at(int column, int row) const {
    return static_cast<std::uint16_t>(pairs[static_cast<std::size_t>(row + 1) * stride + (column + 1)]);
  }
  // The pixels alone, border and all: (width + 2) x (height + 2).
  Array2d<std::uint16_t> pixels_with_border() const;

  // Bilinear, grey levels, double precision. `position` in this level's pixels, on the image.
  double sample(Vec2d position) const {
    const Tap x = tap_at(position.x, width), y = tap_at(position.y, height);
    const std::uint32_t* pair = pairs.data() + static_cast<std::size_t>(y.index + 1) * stride + (x.index + 1);
    const std::uint32_t left = pair[0], right = pair[1];
    return mix(mix(left & 0xFFFF, right & 0xFFFF, x.weight), mix(left >> 16, right >> 16, x.weight), y.weight) /
           kLuminanceScale;
  }
};

class ImagePyramid {
 public:
  // Each level is normalised by itself, in its own pixels.
  explicit ImagePyramid(Array2d<Rgb8> photograph, Normalization normalization = {});

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
  double sample_luminance(Vec2d pixel, int level) const {
    return luminance_[level].sample(1.0 / (std::int64_t{1} << level) * pixel);
  }
  Rgb8 sample_color(Vec2d pixel, int level) const;

 private:
  std::uint64_t id_;
  std::vector<LuminanceLevel> luminance_;
  std::vector<Array2d<Rgb8>> color_;
};

}  // namespace skysweep::sweep
