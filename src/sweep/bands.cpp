// SPDX-License-Identifier: Apache-2.0
#include "sweep/bands.h"

#include <algorithm>

#include "sweep/cost_volume.h"

namespace skysweep::sweep {
namespace {

constexpr int kCollarBlocks =
    64 / kBlockCells;  // swept beyond the core on both sides: paths forget within 64 cells what lies behind

Band band_around(int core_first, int core_last, int block_rows) {
  return {std::max(0, core_first - kCollarBlocks), std::min(block_rows, core_last + kCollarBlocks), core_first,
          core_last};
}

template <typename T>
void copy_rows(const Array2d<T>& from, int from_row, int to_row, int rows, Array2d<T>& to) {
  std::copy_n(from.row(from_row), static_cast<std::size_t>(rows) * from.width(), to.row(to_row));
}

}  // namespace

std::vector<Band> bands_within(const SweepProblem& problem) {
  const int block_rows = problem.block_planes.height();
  const std::size_t limit = static_cast<std::size_t>(problem.options.volume_limit_mib) << 20;
  std::vector<Band> bands;
  for (int first = 0; first < block_rows;) {
    int last = block_rows;
    while (last > first + 1 && CostVolume::bytes_for(part_of(problem, band_around(first, last, block_rows))) > limit)
      --last;
    bands.push_back(band_around(first, last, block_rows));
    first = last;
  }
  return bands;
}

SweepProblem part_of(const SweepProblem& problem, const Band& band) {
  SweepProblem part = problem;
  const int first_row = band.swept_first * kBlockCells;
  part.grid.height = std::min(problem.grid.height, band.swept_last * kBlockCells) - first_row;
  part.grid.north_west_corner.y -= first_row * problem.grid.cell_m;
  if (!problem.expected_plane.empty())
    part.expected_plane = crop(problem.expected_plane, 0, first_row, problem.grid.width, part.grid.height);
  if (!problem.guide.empty()) part.guide = crop(problem.guide, 0, first_row, problem.grid.width, part.grid.height);
  part.visibility.first_row += first_row;
  part.block_planes =
      crop(problem.block_planes, 0, band.swept_first, problem.block_planes.width(), band.swept_last - band.swept_first);
  return part;
}

void copy_core(const MatchResult& part, const Band& band, MatchResult& whole) {
  const int to_row = band.core_first * kBlockCells;
  const int from_row = to_row - band.swept_first * kBlockCells;
  const int rows = std::min(whole.plane.height(), band.core_last * kBlockCells) - to_row;
  copy_rows(part.plane, from_row, to_row, rows, whole.plane);
  copy_rows(part.cost, from_row, to_row, rows, whole.cost);
  copy_rows(part.mean_cost, from_row, to_row, rows, whole.mean_cost);
  copy_rows(part.fraction, from_row, to_row, rows, whole.fraction);
  copy_rows(part.bend, from_row, to_row, rows, whole.bend);
  copy_rows(part.rival_plane, from_row, to_row, rows, whole.rival_plane);
  copy_rows(part.rival_excess, from_row, to_row, rows, whole.rival_excess);
}

}  // namespace skysweep::sweep
