// SPDX-License-Identifier: Apache-2.0
#include "sweep/small_patches.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace skysweep::sweep {
namespace {

void flood(const Array2d<float>& height_m, double agreement_m, Array2d<std::uint8_t>& visited, Patch& patch) {
  for (std::size_t next = 0; next < patch.size(); ++next) {
    const auto [column, row] = patch[next];
    for (const auto [x, y] : {PatchCell{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}}) {
      if (!height_m.contains(x, y) || visited(x, y)) continue;
      if (!(std::abs(height_m(x, y) - height_m(column, row)) <= agreement_m)) continue;  // NaN never agrees
      visited(x, y) = 1;
      patch.push_back({x, y});
    }
  }
}

}  // namespace

void for_each_small_patch(const Array2d<float>& height_m, double agreement_m, int smallest_cells,
                          const std::function<void(const Patch&)>& f) {
  Array2d<std::uint8_t> visited(height_m.width(), height_m.height(), 0);
  Patch patch;
  for (int row = 0; row < height_m.height(); ++row) {
    for (int column = 0; column < height_m.width(); ++column) {
      if (visited(column, row) || std::isnan(height_m(column, row))) continue;
      patch.assign(1, {column, row});
      visited(column, row) = 1;
      flood(height_m, agreement_m, visited, patch);
      if (patch.size() < static_cast<std::size_t>(smallest_cells)) f(patch);
    }
  }
}

Array2d<float> without_small_patches(const Array2d<float>& height_m, double agreement_m, int smallest_cells) {
  Array2d<float> out = height_m;
  for_each_small_patch(height_m, agreement_m, smallest_cells, [&](const Patch& patch) {
    for (const auto [column, row] : patch) out(column, row) = std::numeric_limits<float>::quiet_NaN();
  });
  return out;
}

}  // namespace skysweep::sweep
