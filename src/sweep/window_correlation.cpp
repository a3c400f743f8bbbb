// SPDX-License-Identifier: Apache-2.0
#include "sweep/window_correlation.h"

#include <algorithm>
#include <cmath>

namespace skysweep::sweep {

WindowCorrelation::WindowCorrelation(const Array2d<float>& image)
    : image_(image),
      sum_(std::max(0, image.width() - 2 * kRadius), std::max(0, image.height() - 2 * kRadius)),
      variance_(sum_.width(), sum_.height()),
      wide_(image.width()) {
  for (RowSums& sums : rows_)
    for (std::vector<double>* values : {&sums.b, &sums.bb, &sums.ab}) values->resize(sum_.width());
  for (int y = 0; y < sum_.height(); ++y) {
    for (int x = 0; x < sum_.width(); ++x) {
      double a = 0, aa = 0;
      for (int dy = 0; dy < kWindow; ++dy)
        for (int dx = 0; dx < kWindow; ++dx) {
          const double value = image(x + dx, y + dy);
          a += value, aa += value * value;
        }
      sum_(x, y) = a;
      variance_(x, y) = aa - a * a / kPixels;
    }
  }
}

void WindowCorrelation::sum_row(int row, const float* other) {
  RowSums& sums = rows_[row % kWindow];
  const float* image = image_.row(row);
  std::copy(other, other + image_.width(), wide_.begin());
  const double* wide = wide_.data();
  double *b = sums.b.data(), *bb = sums.bb.data(), *ab = sums.ab.data();
  for (int x = 0; x < sum_.width(); ++x) {
    const double* v = wide + x;
    const float* a = image + x;
    b[x] = v[0] + v[1] + v[2] + v[3] + v[4];
    bb[x] = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3] + v[4] * v[4];
    ab[x] = a[0] * v[0] + a[1] * v[1] + a[2] * v[2] + a[3] * v[3] + a[4] * v[4];
  }
}

void WindowCorrelation::add(const Array2d<float>& other, Array2d<float>& sum, Array2d<float>& count) {
  for (int row = 0; row < other.height(); ++row) {
    sum_row(row, other.row(row));
    const int first = row - 2 * kRadius;  // row of the windows that end here
    if (first < 0) continue;
    const double *a = sum_.row(first), *variance_a = variance_.row(first);
    float *sums = sum.row(row - kRadius) + kRadius, *counts = count.row(row - kRadius) + kRadius;
    const auto total = [this](std::vector<double> RowSums::*of, int x) {
      return (rows_[0].*of)[x] + (rows_[1].*of)[x] + (rows_[2].*of)[x] + (rows_[3].*of)[x] + (rows_[4].*of)[x];
    };
    for (int x = 0; x < sum_.width(); ++x) {
      const double b = total(&RowSums::b, x);
      const double variance_b = total(&RowSums::bb, x) - b * b / kPixels;
      if (!(variance_a[x] > kPixels && variance_b > kPixels)) continue;
      const double covariance = total(&RowSums::ab, x) - a[x] * b / kPixels;
      sums[x] += static_cast<float>(covariance / std::sqrt(variance_a[x] * variance_b));
      counts[x] += 1;
    }
  }
}

}  // namespace skysweep::sweep
