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

// One cell's step along its paths. `costs` and `sums` are the cell's values in their volumes, `before` and `now` path
// costs addressed from the lowest plane of all: before[i] may be read one plane below and a vector beyond each of the
// cell's ranges, and is null where the path begins.
struct CellUpdate {
  const PlaneSet* planes = nullptr;
  int lowest_plane = 0;
  const Cost* costs = nullptr;
  Cost* sums = nullptr;
  std::array<const Cost*, kPathsPerPass> before{};
  std::array<Cost*, kPathsPerPass> now{};
  std::array<Cost, kPathsPerPass> least_before{};
  mutable std::array<Cost, kPathsPerPass> least_now{};
  Cost small_penalty = 0;
  std::array<Cost, kPathsPerPass> large_penalty{};
};

// Path costs addressed by absolute plane, so that neighbours with different ranges meet at the right planes;
// kBeyondRange wherever a cell has no plane.
class PathRows {
 public:
  PathRows(int width, PlaneRange all) : stride_(kMargin + all.count() + 2 * kVolumeLanes), width_(width) {
    for (Row& row : rows_) {
      for (auto& values : row.values) values.assign(static_cast<std::size_t>(stride_) * width, kBeyondRange);
      for (auto& least : row.least) least.assign(width, 0);
      row.planes.assign(width, nullptr);
    }
  }

  // The row in work becomes the row before.
  void begin_row() { std::swap(rows_[0], rows_[1]); }

  // Of a cell, from the lowest plane of all on.
  Cost* values(int path, int column, bool in_work) {
    return rows_[in_work].values[path].data() + static_cast<std::size_t>(column) * stride_ + kMargin;
  }
  Cost& least(int path, int column, bool in_work) { return rows_[in_work].least[path][column]; }

  // Before a cell of the row in work is written: what an earlier row left outside its planes goes.
  void forget_outside(int column, const PlaneSet& planes) {
    Row& row = rows_[1];
    if (row.planes[column] && *row.planes[column] == planes) return;
    for (auto& values : row.values)
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(column) * stride_, stride_, kBeyondRange);
    row.planes[column] = &planes;
  }

 private:
  static constexpr int kMargin = kVolumeLanes;
  static_assert(kMargin > kSteepestExpectedRise);
  struct Row {
    std::array<std::vector<Cost>, kPathsPerPass> values;
    std::array<std::vector<Cost>, kPathsPerPass> least;
    std::vector<const PlaneSet*> planes;  // of each cell last written
  };
  int stride_, width_;
  std::array<Row, 2> rows_;  // [0] the row before, [1] the row in work
};

}  // namespace skysweep::sweep::cpu
