// SPDX-License-Identifier: Apache-2.0
#include "sweep/sub_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sweep/costs_near_best.h"

namespace skysweep::sweep {
namespace {

// Rows refined at a time: their costs, and those of the rows that they reach, lie in the cache of a core.
constexpr int kStripRows = 32;

// Sums of costs at one plane and its neighbours: whole numbers, so the order of addition does not matter.
struct CostTriple {
  std::array<std::int64_t, 3> sum{};
  double rise_error = 0;  // of the cells that were added up
  int cells = 0;
};

// The cells that refining those of rows [first, last) reads.
class Strip {
 public:
  Strip(const SweepProblem& problem, const CostVolume& costs, const MatchResult& result, int first, int last)
      : radius_(problem.options.refinement_radius_cells),
        width_(costs.width()),
        top_(std::max(0, first - radius_)),
        bottom_(std::min(costs.height(), last + radius_)),
        cells_(costs_near_best(problem, costs, result, top_, bottom_)) {}

  // Costs of the surface that passes plane `plane` of a cell.
  CostTriple costs_around(int column, int row, int plane) const {
    CostTriple triple;
    const CostsNearBest& own = cell(column, row);
    const int left = std::max(0, column - radius_), right = std::min(width_ - 1, column + radius_);
    for (int y = std::max(top_, row - radius_); y <= std::min(bottom_ - 1, row + radius_); ++y) {
      const CostsNearBest* other = &cell(left, y);
      for (int x = left; x <= right; ++x, ++other) add(own, *other, plane, triple);
    }
    return triple;
  }

  // Planes above the cell's best one; NaN if the cells around do not tell.
  double refined_fraction(int column, int row) const {
    const int best = cell(column, row).best;
    CostTriple around = costs_around(column, row, best);
    // Where two planes are nearly equal, chance chose between them: the least of the common costs must not depend on
    // it.
    const int step = around.sum[0] < around.sum[1] ? -1 : around.sum[2] < around.sum[1] ? 1 : 0;
    if (step != 0) around = costs_around(column, row, best + step);
    const auto [below, middle, above] = around.sum;
    const double mean_rise_error = around.cells > 0 ? around.rise_error / around.cells : 0;
    return step - mean_rise_error +
           std::clamp(
               sub_plane_vertex(static_cast<double>(below), static_cast<double>(middle), static_cast<double>(above)),
               -0.5, 0.5);
  }

 private:
  const CostsNearBest& cell(int column, int row) const {
    return cells_[static_cast<std::size_t>(row - top_) * width_ + column];
  }

  void add(const CostsNearBest& own, const CostsNearBest& other, int plane, CostTriple& triple) const {
    // As SweepProblem::expected_rise.
    int rise = 0;
    float error = 0;
    if (own.expected != kNothingExpected && other.expected != kNothingExpected &&
        std::abs(other.expected - own.expected) <= kSteepestExpectedRise * radius_) {
      rise = other.expected - own.expected;
      error = other.expected_exactly - own.expected_exactly - static_cast<float>(rise);
    }
    const int slot = plane + rise - other.best + kSameSurfacePlanes;
    if (slot < 0 || slot > 2 * kSameSurfacePlanes || (other.usable >> slot & 1) == 0) return;
    for (int i = 0; i < 3; ++i) triple.sum[i] += other.costs[slot + i];
    triple.rise_error += error;
    ++triple.cells;
  }

  int radius_, width_, top_, bottom_;
  std::vector<CostsNearBest> cells_;
};

}  // namespace

double sub_plane_vertex(double below, double middle, double above) {
  const double bend = below - 2 * middle + above, rise = std::max(below, above) - middle;
  if (!(bend > 0 && rise > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double lean = 0.5 * (below - above);
  return 0.5 * (lean / bend + lean / rise);
}

void refine_fractions(const SweepProblem& problem, const CostVolume& costs, Executor& executor, MatchResult& result) {
  if (problem.options.refinement_radius_cells == 0) return;
  executor.parallel_for((costs.height() + kStripRows - 1) / kStripRows, [&](int strip) {
    const int first = strip * kStripRows, last = std::min(costs.height(), first + kStripRows);
    const Strip cells(problem, costs, result, first, last);
    for (int row = first; row < last; ++row) {
      for (int column = 0; column < costs.width(); ++column) {
        if (!std::isfinite(result.fraction(column, row))) continue;
        const double fraction = cells.refined_fraction(column, row);
        if (std::isfinite(fraction)) result.fraction(column, row) = static_cast<float>(fraction);
      }
    }
  });
}

}  // namespace skysweep::sweep
