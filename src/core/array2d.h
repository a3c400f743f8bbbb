// SPDX-License-Identifier: Apache-2.0
// A dense 2D array, row-major; rows run from north to south wherever the array is a raster.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/check.h"

namespace skysweep {

template <typename T>
class Array2d {
 public:
  Array2d() = default;
  Array2d(int width, int height, T value = T{}) : width_(width), height_(height) {
    SKY_CHECK_GE(width, 0);
    SKY_CHECK_GE(height, 0);
    values_.assign(static_cast<std::size_t>(width) * height, value);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  bool contains(int column, int row) const { return column >= 0 && column < width_ && row >= 0 && row < height_; }

  T& operator()(int column, int row) { return values_[static_cast<std::size_t>(row) * width_ + column]; }
  const T& operator()(int column, int row) const { return values_[static_cast<std::size_t>(row) * width_ + column]; }
  T* row(int row) { return values_.data() + static_cast<std::size_t>(row) * width_; }
  const T* row(int row) const { return values_.data() + static_cast<std::size_t>(row) * width_; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  friend bool operator==(const Array2d&, const Array2d&) = default;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<T> values_;
};

// The part of `source` that starts at (column, row) and is width x height large; it must lie inside.
template <typename T>
Array2d<T> crop(const Array2d<T>& source, int column, int row, int width, int height) {
  SKY_CHECK(column >= 0 && row >= 0 && column + width <= source.width() && row + height <= source.height());
  Array2d<T> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out(x, y) = source(column + x, row + y);
  return out;
}

}  // namespace skysweep
