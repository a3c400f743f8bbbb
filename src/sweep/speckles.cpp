// SPDX-License-Identifier: Apache-2.0
#include "sweep/speckles.h"

#include <algorithm>
#include <cmath>
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

// How much of the surroundings of a cell belongs to patches that are not small.
class Support {
 public:
  explicit Support(const Array2d<float>& large_patches)
      : sums_(large_patches.width() + 1, large_patches.height() + 1, 0) {
    for (int y = 0; y < large_patches.height(); ++y)
      for (int x = 0; x < large_patches.width(); ++x)
        sums_(x + 1, y + 1) =
            sums_(x, y + 1) + sums_(x + 1, y) - sums_(x, y) + (std::isnan(large_patches(x, y)) ? 0 : 1);
  }

  double around(PatchCell cell) const {
    const int left = std::max(0, cell.column - kSupportRadius), top = std::max(0, cell.row - kSupportRadius);
    const int right = std::min(sums_.width() - 1, cell.column + kSupportRadius + 1);
    const int bottom = std::min(sums_.height() - 1, cell.row + kSupportRadius + 1);
    const int cells = sums_(right, bottom) - sums_(left, bottom) - sums_(right, top) + sums_(left, top);
    return static_cast<double>(cells) / ((right - left) * (bottom - top));
  }

 private:
  Array2d<int> sums_;
};

}  // namespace

void drop_speckles(const SweepProblem& problem, Heights& heights) {
  if (problem.options.speckle_cells == 0) return;
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  const Array2d<std::uint8_t> level = level_cells(problem, heights.height_m);
  const Array2d<float> before = heights.height_m;
  const double agreement_m = kSpecklePatchPlanes * problem.dz_m;
  const Support support(without_small_patches(before, agreement_m, problem.options.speckle_cells));
  for_each_small_patch(before, agreement_m, problem.options.speckle_cells, [&](const Patch& patch) {
    if (support.around(patch.front()) < kSmallestSupport) return;
    if (std::any_of(patch.begin(), patch.end(), [&](PatchCell c) { return level(c.column, c.row) != 0; })) return;
    for (const auto [column, row] : patch) heights.height_m(column, row) = heights.sigma_m(column, row) = kNoData;
  });
}

}  // namespace skysweep::sweep
