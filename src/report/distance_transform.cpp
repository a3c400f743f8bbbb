// SPDX-License-Identifier: Apache-2.0
#include "report/distance_transform.h"

#include <limits>
#include <vector>

namespace skysweep::report {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Squared distance to the nearest mark of the same column: one scan down, one up.
Array2d<float> along_columns(const Array2d<std::uint8_t>& marked) {
  Array2d<float> out(marked.width(), marked.height(), kInfinity);
  for (int column = 0; column < marked.width(); ++column) {
    float distance = kInfinity;
    for (int row = 0; row < marked.height(); ++row) {
      distance = marked(column, row) ? 0 : distance + 1;
      out(column, row) = distance;
    }
    distance = kInfinity;
    for (int row = marked.height() - 1; row >= 0; --row) {
      distance = marked(column, row) ? 0 : distance + 1;
      if (distance < out(column, row)) out(column, row) = distance;
      out(column, row) *= out(column, row);
    }
  }
  return out;
}

// min over q of (x - q)^2 + f(q): the lower envelope of one parabola per cell of a row.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(int width) : values_(width), apex_(width), from_(width) {}

  void replace_by_minimum(float* row) {
    const int width = static_cast<int>(values_.size());
    int count = 0;
    for (int q = 0; q < width; ++q) {
      values_[q] = row[q];
      if (row[q] == kInfinity) continue;
      double start = -std::numeric_limits<double>::infinity();
      while (count > 0 && (start = crossing(apex_[count - 1], q)) <= from_[count - 1]) --count;
      if (count == 0) start = -std::numeric_limits<double>::infinity();
      apex_[count] = q;
      from_[count] = start;
      ++count;
    }
    if (count == 0) return;
    for (int x = 0, k = 0; x < width; ++x) {
      while (k + 1 < count && from_[k + 1] <= x) ++k;
      const double distance = x - apex_[k];
      row[x] = static_cast<float>(distance * distance + values_[apex_[k]]);
    }
  }

 private:
  // Where the parabola of the later cell q comes to lie below that of p.
  double crossing(int p, int q) const {
    return ((values_[q] + static_cast<double>(q) * q) - (values_[p] + static_cast<double>(p) * p)) / (2.0 * (q - p));
  }

  std::vector<double> values_;  // of the row before it was replaced
  std::vector<int> apex_;       // cells whose parabolas form the envelope, from west to east
  std::vector<double> from_;    // where each begins to be the lowest
};

}  // namespace

Array2d<float> squared_distance_to(const Array2d<std::uint8_t>& marked) {
  Array2d<float> out = along_columns(marked);
  LowerEnvelope envelope(marked.width());
  for (int row = 0; row < marked.height(); ++row) envelope.replace_by_minimum(out.row(row));
  return out;
}

}  // namespace skysweep::report
