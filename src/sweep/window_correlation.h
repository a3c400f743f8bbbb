// SPDX-License-Identifier: Apache-2.0
// Zero-mean normalised cross-correlation of the windows around all pixels of two images, by separable sums.
#pragma once

#include <array>
#include <vector>

#include "core/array2d.h"

namespace skysweep::sweep {

class WindowCorrelation {
 public:
  static constexpr int kRadius = 2;  // windows of 5 x 5 pixels

  // `image` is compared with others; grey levels, no NaN.
  explicit WindowCorrelation(const Array2d<float>& image);

  // Adds the correlation with `other`, of the same size, to `sum` and one to `count` at every pixel that has one:
  // windows lie within the images, have texture in both (a standard deviation of a grey level) and no NaN.
  void add(const Array2d<float>& other, Array2d<float>& sum, Array2d<float>& count);

 private:
  static constexpr int kWindow = 2 * kRadius + 1;
  static constexpr double kPixels = kWindow * kWindow;

  // Sums over the part of the windows that lies in one row, at each window's first column.
  struct RowSums {
    std::vector<double> b, bb, ab;
  };
  void sum_row(int row, const float* other);

  Array2d<float> image_;
  Array2d<double> sum_, variance_;  // of its windows, at the windows' first pixels; the variance times kPixels
  std::array<RowSums, kWindow> rows_;
  std::vector<double> wide_;  // a row of the other image in double precision
};

}  // namespace skysweep::sweep
