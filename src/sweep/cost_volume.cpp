// SPDX-License-Identifier: Apache-2.0
#include "sweep/cost_volume.h"

#include <algorithm>
#include <cmath>

namespace skysweep::sweep {

CostVolume::CostVolume(const SweepProblem& problem, Cost value)
    : width_(problem.grid.width),
      height_(problem.grid.height),
      all_planes_(problem.all_planes()),
      block_planes_(problem.block_planes),
      cell_size_(block_planes_.width(), block_planes_.height()),
      block_offset_(block_planes_.width(), block_planes_.height()) {
  std::size_t size = 0;
  for (int by = 0; by < block_planes_.height(); ++by) {
    std::size_t in_row = 0;
    for (int bx = 0; bx < block_planes_.width(); ++bx) {
      block_offset_(bx, by) = in_row;
      cell_size_(bx, by) = padded_planes(block_planes_(bx, by));
      const int cells = std::min(kBlockCells, width_ - bx * kBlockCells);
      in_row += static_cast<std::size_t>(cells) * cell_size_(bx, by);
    }
    for (int row = by * kBlockCells; row < std::min(height_, (by + 1) * kBlockCells); ++row) {
      row_offset_.push_back(size);
      size += in_row;
    }
  }
  values_.assign(size + 2 * kVolumeLanes, kBeyondRange);
  for (int row = 0; row < height_; ++row)
    for (int column = 0; column < width_; ++column)
      for_each_stored_range(planes_at(column, row), [&](StoredRange range) {
        std::fill_n(cell(column, row) + range.slot, range.planes.count(), value);
      });
}

std::size_t CostVolume::offset(int column, int row) const {
  const int bx = column / kBlockCells, by = row / kBlockCells;
  const auto within = static_cast<std::size_t>(column - bx * kBlockCells);
  return kVolumeLanes + row_offset_[row] + block_offset_(bx, by) + within * cell_size_(bx, by);
}

int CostVolume::padded_planes(const PlaneSet& planes) {
  int elements = 0;
  for (const PlaneRange& range : planes.ranges()) elements += sweep::padded_planes(range);
  return elements;
}

std::size_t CostVolume::bytes_for(const SweepProblem& problem) {
  std::size_t size = 0;
  for (int by = 0; by < problem.block_planes.height(); ++by) {
    for (int bx = 0; bx < problem.block_planes.width(); ++bx) {
      const int width = std::min(kBlockCells, problem.grid.width - bx * kBlockCells);
      const int height = std::min(kBlockCells, problem.grid.height - by * kBlockCells);
      size += static_cast<std::size_t>(width) * height * padded_planes(problem.block_planes(bx, by));
    }
  }
  return size * sizeof(Cost);
}

Cost quantized_cost(double grey_levels) {
  if (!(grey_levels < kWorstCost / kCostScale)) return kWorstCost;
  return static_cast<Cost>(std::nearbyint(grey_levels * kCostScale));
}

}  // namespace skysweep::sweep
