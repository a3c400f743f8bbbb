// SPDX-License-Identifier: Apache-2.0
#include "sweep/local_normalization.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sweep/image_pyramid.h"

namespace skysweep::sweep {
namespace {

// Column sums of the rows within the window of the current row: whole numbers, so that sliding them is exact.
struct ColumnSums {
  explicit ColumnSums(int width) : sum(width, 0), square(width, 0) {}
  void add(const std::uint16_t* row, int sign) {
    for (std::size_t x = 0; x < sum.size(); ++x) {
      const std::int64_t value = row[x];
      sum[x] += sign * value;
      square[x] += sign * value * value;
    }
  }
  std::vector<std::int64_t> sum, square;
};

}  // namespace

std::uint16_t normalized(double value, double mean, double variance) {
  const double deviation =
      std::sqrt(std::max(0.0, variance) + kNoiseFloor * kNoiseFloor * kLuminanceScale * kLuminanceScale);
  const double grey = std::clamp(kNormalizedMean + kNormalizedDeviation * (value - mean) / deviation, 0.0, 255.0);
  return static_cast<std::uint16_t>(grey * kLuminanceScale + 0.5);
}

void normalize_locally(Array2d<std::uint16_t>& luminance, int radius_px) {
  const Array2d<std::uint16_t> source = luminance;
  const int width = source.width(), height = source.height();
  ColumnSums columns(width);
  for (int y = 0; y < std::min(radius_px, height); ++y) columns.add(source.row(y), 1);
  for (int y = 0; y < height; ++y) {
    if (y + radius_px < height) columns.add(source.row(y + radius_px), 1);
    if (y - radius_px - 1 >= 0) columns.add(source.row(y - radius_px - 1), -1);
    const int rows = std::min(height - 1, y + radius_px) - std::max(0, y - radius_px) + 1;
    std::int64_t sum = 0, square = 0;
    for (int x = 0; x < std::min(radius_px, width); ++x) sum += columns.sum[x], square += columns.square[x];
    for (int x = 0; x < width; ++x) {
      if (x + radius_px < width) sum += columns.sum[x + radius_px], square += columns.square[x + radius_px];
      if (x - radius_px - 1 >= 0) sum -= columns.sum[x - radius_px - 1], square -= columns.square[x - radius_px - 1];
      const int across = std::min(width - 1, x + radius_px) - std::max(0, x - radius_px) + 1;
      const double count = static_cast<double>(rows) * across;
      const double mean = static_cast<double>(sum) / count;
      luminance(x, y) = normalized(source(x, y), mean, static_cast<double>(square) / count - mean * mean);
    }
  }
}

}  // namespace skysweep::sweep
