// SPDX-License-Identifier: Apache-2.0
// The matching costs of all cells and planes of a problem, whole numbers of kCostScale units a grey level, so that what
// is computed from them is exact. Planes lie innermost; each block of cells has its own planes, range after range.
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
constexpr int kVolumeLanes = 16;              // the planes of each range of a cell are padded to a multiple of this

// Elements that one cell takes for a range.
inline int padded_planes(PlaneRange range) { return (range.count() + kVolumeLanes - 1) / kVolumeLanes * kVolumeLanes; }

// Where among the values of a cell those of a range begin.
struct StoredRange {
  PlaneRange planes;
  int slot = 0;
};

// Goes through the ranges of a set in the order in which a cell's values are stored.
template <typename Visit>
void for_each_stored_range(const PlaneSet& planes, Visit visit) {
  int slot = 0;
  for (const PlaneRange& range : planes.ranges()) {
    visit(StoredRange{range, slot});
    slot += padded_planes(range);
  }
}

class CostVolume {
 public:
  // All cells of the problem, filled with `value`; padding with kBeyondRange.
  CostVolume(const SweepProblem& problem, Cost value);

  int width() const { return width_; }
  int height() const { return height_; }
  const PlaneSet& planes_at(int column, int row) const {
    return block_planes_(column / kBlockCells, row / kBlockCells);
  }
  PlaneRange all_planes() const { return all_planes_; }

  // Values of a cell, as for_each_stored_range goes through them.
  Cost* cell(int column, int row) { return values_.data() + offset(column, row); }
  const Cost* cell(int column, int row) const { return values_.data() + offset(column, row); }

  std::size_t bytes() const { return (values_.size() - 2 * kVolumeLanes) * sizeof(Cost); }

  // Elements that one cell of a block with these planes takes.
  static int padded_planes(const PlaneSet& planes);
  // Bytes of a volume for the problem, without making it.
  static std::size_t bytes_for(const SweepProblem& problem);

  friend bool operator==(const CostVolume& a, const CostVolume& b) { return a.values_ == b.values_; }

 private:
  std::size_t offset(int column, int row) const;

  int width_ = 0, height_ = 0;
  PlaneRange all_planes_;
  Array2d<PlaneSet> block_planes_;
  Array2d<int> cell_size_;               // elements of each cell of a block
  Array2d<std::size_t> block_offset_;    // of the block's first cell within a row of cells
  std::vector<std::size_t> row_offset_;  // of each row of cells
  std::vector<Cost> values_;  // with a vector before the first and behind the last, for whoever reads neighbours
};

// Whole-number cost of a mean absolute difference in grey levels; infinity becomes kWorstCost.
Cost quantized_cost(double grey_levels);

}  // namespace skysweep::sweep
