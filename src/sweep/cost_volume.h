// SPDX-License-Identifier: Apache-2.0
// The matching costs of all cells and planes of a problem, whole numbers of kCostScale units a grey level, so that what
// is computed from them is exact. Planes lie innermost; each block of cells has its own range of planes.
// Why 32 bits: docs/decisions/0006.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

using Cost = std::int32_t;

constexpr double kCostScale = 1 << 20;  // units per grey level: below what single precision resolves in a cost
constexpr Cost kWorstCost = 125 << 19;  // 62.5 grey levels: fewer than min_views views, and the limit of all costs
constexpr Cost kBeyondRange = (1 << 30) - 1;  // padding behind the last plane: above any sum of eight paths
constexpr int kVolumeLanes = 16;              // planes of a cell are padded to a multiple of this

class CostVolume {
 public:
  // All cells of the problem, filled with `value`; padding with kBeyondRange.
  CostVolume(const SweepProblem& problem, Cost value);

  int width() const { return width_; }
  int height() const { return height_; }
  PlaneRange planes_at(int column, int row) const { return block_planes_(column / kBlockCells, row / kBlockCells); }
  PlaneRange all_planes() const { return all_planes_; }

  // Values of a cell, the first for planes_at(column, row).first.
  Cost* cell(int column, int row) { return values_.data() + offset(column, row); }
  const Cost* cell(int column, int row) const { return values_.data() + offset(column, row); }

  std::size_t bytes() const { return values_.size() * sizeof(Cost); }

  // Elements that one cell of a block with this range takes.
  static int padded_planes(PlaneRange planes) {
    return (planes.count() + kVolumeLanes - 1) / kVolumeLanes * kVolumeLanes;
  }
  // Bytes of a volume for the problem, without making it.
  static std::size_t bytes_for(const SweepProblem& problem);

  friend bool operator==(const CostVolume& a, const CostVolume& b) { return a.values_ == b.values_; }

 private:
  std::size_t offset(int column, int row) const;

  int width_ = 0, height_ = 0;
  PlaneRange all_planes_;
  Array2d<PlaneRange> block_planes_;
  Array2d<std::size_t> block_offset_;    // of the block's first cell within a row of cells
  std::vector<std::size_t> row_offset_;  // of each row of cells
  std::vector<Cost> values_;
};

// Whole-number cost of a mean absolute difference in grey levels; infinity becomes kWorstCost.
Cost quantized_cost(double grey_levels);

}  // namespace skysweep::sweep
