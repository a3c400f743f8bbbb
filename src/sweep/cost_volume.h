// SPDX-License-Identifier: Apache-2.0
// The matching costs of all cells and planes of a problem, whole numbers of kCostScale units a grey level, so that what
// is computed from them is exact. Planes lie innermost; each block of cells has its own range of planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

constexpr double kCostScale = 64;              // units per grey level
constexpr std::uint16_t kWorstCost = 4000;     // where fewer than min_views views show the sample, and the limit of all
constexpr std::uint16_t kBeyondRange = 65535;  // padding behind the last plane: no sum gets past it
constexpr int kVolumeLanes = 32;               // planes of a cell are padded to a multiple of this

class CostVolume {
 public:
  // All cells of the problem, filled with `value`; padding with kBeyondRange.
  CostVolume(const SweepProblem& problem, std::uint16_t value);

  int width() const { return width_; }
  int height() const { return height_; }
  PlaneRange planes_at(int column, int row) const { return block_planes_(column / kBlockCells, row / kBlockCells); }
  PlaneRange all_planes() const { return all_planes_; }

  // Values of a cell, the first for planes_at(column, row).first.
  std::uint16_t* cell(int column, int row) { return values_.data() + offset(column, row); }
  const std::uint16_t* cell(int column, int row) const { return values_.data() + offset(column, row); }

  std::size_t bytes() const { return values_.size() * sizeof(std::uint16_t); }

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
  std::vector<std::uint16_t> values_;
};

// Whole-number cost of a mean absolute difference in grey levels; infinity becomes kWorstCost.
std::uint16_t quantized_cost(double grey_levels);

}  // namespace skysweep::sweep
