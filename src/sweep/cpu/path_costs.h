// SPDX-License-Identifier: Apache-2.0
// What the smoothing carries from row to row: the path costs of the row before and of the row in work, for the four
// directions of a pass.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "sweep/cost_volume.h"

namespace skysweep::sweep::cpu {

constexpr int kPathsPerPass = 4;

// One cell's step along its paths; pointers stand at the cell's first plane. before[i] may be read one plane below and
// a vector beyond the cell's range; null where the path begins.
struct CellUpdate {
  const Cost* costs = nullptr;
  Cost* sums = nullptr;
  std::array<const Cost*, kPathsPerPass> before{};
  std::array<Cost*, kPathsPerPass> now{};
  std::array<Cost, kPathsPerPass> least_before{};
  mutable std::array<Cost, kPathsPerPass> least_now{};
  int padded_planes = 0;
  Cost small_penalty = 0, large_penalty = 0;
};

// Path costs addressed by absolute plane, so that neighbours with different ranges meet at the right planes;
// kBeyondRange wherever a cell has no plane.
class PathRows {
 public:
  PathRows(int width, PlaneRange all)
      : first_plane_(all.first), stride_(kMargin + all.count() + 2 * kVolumeLanes), width_(width) {
    for (Row& row : rows_) {
      for (auto& values : row.values) values.assign(static_cast<std::size_t>(stride_) * width, kBeyondRange);
      for (auto& least : row.least) least.assign(width, 0);
      row.ranges.assign(width, PlaneRange{});
    }
  }

  // The row in work becomes the row before.
  void begin_row() { std::swap(rows_[0], rows_[1]); }

  Cost* values(int path, int column, bool in_work, int plane) {
    return rows_[in_work].values[path].data() + static_cast<std::size_t>(column) * stride_ + kMargin + plane -
           first_plane_;
  }
  Cost& least(int path, int column, bool in_work) { return rows_[in_work].least[path][column]; }

  // Before a cell of the row in work is written: what an earlier row left outside its planes goes.
  void forget_outside(int column, PlaneRange planes) {
    Row& row = rows_[1];
    if (row.ranges[column] == planes) return;
    for (auto& values : row.values)
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(column) * stride_, stride_, kBeyondRange);
    row.ranges[column] = planes;
  }

 private:
  static constexpr int kMargin = kVolumeLanes;
  struct Row {
    std::array<std::vector<Cost>, kPathsPerPass> values;
    std::array<std::vector<Cost>, kPathsPerPass> least;
    std::vector<PlaneRange> ranges;  // of each cell last written
  };
  int first_plane_, stride_, width_;
  std::array<Row, 2> rows_;  // [0] the row before, [1] the row in work
};

}  // namespace skysweep::sweep::cpu
