// SPDX-License-Identifier: Apache-2.0
#include "sweep/speckles.h"

#include <algorithm>
#include <limits>

#include "sweep/small_patches.h"

namespace skysweep::sweep {
namespace {

// 1 for the cells of level parts that are large enough.
Array2d<std::uint8_t> level_cells(const SweepProblem& problem, const Array2d<float>& height_m) {
  Array2d<std::uint8_t> level(height_m.width(), height_m.height(), 1);
  const int smallest = (problem.options.speckle_cells + kLevelShare - 1) / kLevelShare;
  for_each_small_patch(height_m, kLevelPlanes * problem.dz_m, smallest, [&](const Patch& part) {
    for (const auto [column, row] : part) level(column, row) = 0;
  });
  return level;
}

}  // namespace

void drop_speckles(const SweepProblem& problem, Heights& heights) {
  if (problem.options.speckle_cells == 0) return;
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  const Array2d<std::uint8_t> level = level_cells(problem, heights.height_m);
  const Array2d<float> before = heights.height_m;
  for_each_small_patch(
      before, kSpecklePatchPlanes * problem.dz_m, problem.options.speckle_cells, [&](const Patch& patch) {
        if (std::any_of(patch.begin(), patch.end(), [&](PatchCell c) { return level(c.column, c.row) != 0; })) return;
        for (const auto [column, row] : patch) heights.height_m(column, row) = heights.sigma_m(column, row) = kNoData;
      });
}

}  // namespace skysweep::sweep
