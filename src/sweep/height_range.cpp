// SPDX-License-Identifier: Apache-2.0
#include "sweep/height_range.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sweep/heights.h"

namespace skysweep::sweep {
namespace {

// Around the range found, in coarse planes: what the coarse sweep may have missed by its own resolution.
constexpr double kMarginCoarsePlanes = 2;
// A block is searched where the coarse surface lies up to this many coarse cells outside it, too: surfaces near a step
// reach over the border of a block.
constexpr int kNeighborhoodCoarseCells = 4;

SweepProblem coarse_problem(const SweepProblem& fine, double z_low, double z_high) {
  SweepProblem coarse;
  const auto cells = [](int n) { return (n + kCoarseCells - 1) / kCoarseCells; };
  coarse.grid = {cells(fine.grid.width), cells(fine.grid.height), fine.grid.cell_m * kCoarseCells,
                 fine.grid.north_west_corner};
  coarse.dz_m = fine.dz_m * kCoarseCells;
  coarse.views = fine.views;
  for (View& view : coarse.views) view.base_level += std::countr_zero(static_cast<unsigned>(kCoarseCells));
  coarse.options = fine.options;
  coarse.options.window_level_min = 0;
  coarse.options.window_level_max = 2;
  coarse.search_everywhere(planes_between(z_low, z_high, coarse.dz_m, 1));
  return coarse;
}

// Heights that most of their known neighbours confirm to within `agreement_m`; the others become NaN.
Array2d<float> trusted(const Array2d<float>& height, double agreement_m) {
  Array2d<float> out(height.width(), height.height(), std::nanf(""));
  for (int y = 0; y < height.height(); ++y) {
    for (int x = 0; x < height.width(); ++x) {
      int neighbours = 0, agreeing = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if ((dx == 0 && dy == 0) || !height.contains(x + dx, y + dy)) continue;
          ++neighbours;
          agreeing += std::abs(height(x + dx, y + dy) - height(x, y)) <= agreement_m;  // false for NaN
        }
      }
      if (2 * agreeing >= neighbours && agreeing > 0) out(x, y) = height(x, y);
    }
  }
  return out;
}

// Range of the known heights in a window of coarse cells; nothing if there are none.
std::optional<HeightRange> range_within(const Array2d<float>& height, int x0, int y0, int x1, int y1) {
  std::optional<HeightRange> range;
  for (int y = std::max(0, y0); y < std::min(height.height(), y1); ++y) {
    for (int x = std::max(0, x0); x < std::min(height.width(), x1); ++x) {
      const double z = height(x, y);
      if (std::isnan(z)) continue;
      if (!range) range = HeightRange{z, z};
      range->z_low = std::min(range->z_low, z);
      range->z_high = std::max(range->z_high, z);
    }
  }
  return range;
}

}  // namespace

std::optional<HeightRange> find_planes(SweepProblem& problem, double z_low, double z_high, Backend backend,
                                       Executor& executor) {
  const SweepProblem coarse = coarse_problem(problem, z_low, z_high);
  const Heights found = heights_from_matches(coarse, match_planes(coarse, backend, executor));
  const Array2d<float> surface = trusted(found.height_m, 2 * coarse.dz_m);
  const std::optional<HeightRange> whole = range_within(surface, 0, 0, surface.width(), surface.height());
  problem.search_everywhere({});
  if (!whole) return std::nullopt;

  const double margin_m = kMarginCoarsePlanes * coarse.dz_m;
  constexpr int kCoarsePerBlock = kBlockCells / kCoarseCells;
  for (int by = 0; by < problem.block_planes.height(); ++by) {
    for (int bx = 0; bx < problem.block_planes.width(); ++bx) {
      const int x = bx * kCoarsePerBlock, y = by * kCoarsePerBlock;
      constexpr int reach = kNeighborhoodCoarseCells;
      const HeightRange range =
          range_within(surface, x - reach, y - reach, x + kCoarsePerBlock + reach, y + kCoarsePerBlock + reach)
              .value_or(*whole);
      problem.block_planes(bx, by) = planes_between(range.z_low - margin_m, range.z_high + margin_m, problem.dz_m, 1);
    }
  }
  return whole;
}

}  // namespace skysweep::sweep
