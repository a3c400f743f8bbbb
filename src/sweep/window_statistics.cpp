// SPDX-License-Identifier: Apache-2.0
#include "sweep/window_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace skysweep::sweep {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Largest values within `radius` along the rows, then along the columns.
Array2d<float> window_max(const Array2d<float>& values, int radius) {
  const int width = values.width(), height = values.height();
  Array2d<float> across(width, height), out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      across(x, y) =
          *std::max_element(values.row(y) + std::max(0, x - radius), values.row(y) + std::min(width, x + radius + 1));
  for (int y = 0; y < height; ++y) {
    const int top = std::max(0, y - radius), bottom = std::min(height - 1, y + radius);
    std::copy_n(across.row(top), width, out.row(y));
    for (int from = top + 1; from <= bottom; ++from)
      for (int x = 0; x < width; ++x) out(x, y) = std::max(out(x, y), across(x, from));
  }
  return out;
}

Array2d<float> with_nan_as(const Array2d<float>& values, float sign, float other) {
  Array2d<float> out(values.width(), values.height());
  std::transform(values.begin(), values.end(), out.begin(), [=](float v) { return std::isnan(v) ? other : sign * v; });
  return out;
}

// Sums over all cells above and to the left.
struct Sums {
  explicit Sums(const Array2d<float>& values) : sum(values.width() + 1, values.height() + 1, 0) {
    for (int y = 0; y < values.height(); ++y) {
      double row = 0;
      for (int x = 0; x < values.width(); ++x) {
        row += values(x, y);
        sum(x + 1, y + 1) = sum(x + 1, y) + row;
      }
    }
  }
  double over(int left, int top, int right, int bottom) const {
    return sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top);
  }
  Array2d<double> sum;
};

}  // namespace

Array2d<float> window_mean(const Array2d<float>& values, int radius) {
  const int width = values.width(), height = values.height();
  Array2d<float> known(width, height);
  std::transform(values.begin(), values.end(), known.begin(), [](float v) { return std::isnan(v) ? 0.0f : 1.0f; });
  const Sums sums(with_nan_as(values, 1, 0)), counts(known);
  Array2d<float> out(width, height);
  for (int y = 0; y < height; ++y) {
    const int top = std::max(0, y - radius), bottom = std::min(height, y + radius + 1);
    for (int x = 0; x < width; ++x) {
      const int left = std::max(0, x - radius), right = std::min(width, x + radius + 1);
      out(x, y) = static_cast<float>(sums.over(left, top, right, bottom) / counts.over(left, top, right, bottom));
    }
  }
  return out;
}

Array2d<float> window_range(const Array2d<float>& values, int radius) {
  const Array2d<float> highest = window_max(with_nan_as(values, 1, -kInfinity), radius);
  const Array2d<float> lowest = window_max(with_nan_as(values, -1, -kInfinity), radius);
  Array2d<float> out(values.width(), values.height());
  std::transform(highest.begin(), highest.end(), lowest.begin(), out.begin(), [](float high, float minus_low) {
    return high == -kInfinity ? std::numeric_limits<float>::quiet_NaN() : high + minus_low;
  });
  return out;
}

}  // namespace skysweep::sweep
