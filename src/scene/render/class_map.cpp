// SPDX-License-Identifier: Apache-2.0
#include "scene/render/class_map.h"

#include <algorithm>
#include <cmath>

#include "core/vec.h"

namespace skysweep::scene {
namespace {

constexpr double kStep_m = 0.5, kSteepestRoof = 2;  // the last: rise over run

bool solid(SurfaceClass c) {
  return c == SurfaceClass::ground || c == SurfaceClass::roof || c == SurfaceClass::facade_edge ||
         c == SurfaceClass::water;
}

// Marks the cells of `out` around a place, given in cells from the north-west corner.
void mark_around(Vec2d place, double reach_cells, const Array2d<std::uint8_t>& classes, Array2d<std::uint8_t>& out) {
  const int west = std::max(0, static_cast<int>(std::floor(place.x - reach_cells)));
  const int east = std::min(out.width() - 1, static_cast<int>(std::ceil(place.x + reach_cells)));
  const int north = std::max(0, static_cast<int>(std::floor(place.y - reach_cells)));
  const int south = std::min(out.height() - 1, static_cast<int>(std::ceil(place.y + reach_cells)));
  for (int row = north; row <= south; ++row)
    for (int column = west; column <= east; ++column) {
      const auto c = static_cast<SurfaceClass>(classes(column, row));
      if (c != SurfaceClass::ground && c != SurfaceClass::roof) continue;
      if (norm(Vec2d{column + 0.5, row + 0.5} - place) <= reach_cells)
        out(column, row) = static_cast<std::uint8_t>(SurfaceClass::facade_edge);
    }
}

}  // namespace

void mark_facade_edges(const Array2d<float>& height, double cell_m, double reach_m, Array2d<std::uint8_t>& classes) {
  const Array2d<std::uint8_t> plain = classes;
  const double threshold = kStep_m + kSteepestRoof * cell_m;
  const auto step = [&](int column, int row, int other_column, int other_row) {
    const auto a = static_cast<SurfaceClass>(plain(column, row)),
               b = static_cast<SurfaceClass>(plain(other_column, other_row));
    return solid(a) && solid(b) && (a == SurfaceClass::roof || b == SurfaceClass::roof) &&
           std::abs(double{height(column, row)} - height(other_column, other_row)) > threshold;
  };
  for (int row = 0; row < plain.height(); ++row)
    for (int column = 0; column < plain.width(); ++column) {
      if (column + 1 < plain.width() && step(column, row, column + 1, row))
        mark_around({column + 1.0, row + 0.5}, reach_m / cell_m, plain, classes);
      if (row + 1 < plain.height() && step(column, row, column, row + 1))
        mark_around({column + 0.5, row + 1.0}, reach_m / cell_m, plain, classes);
    }
}

}  // namespace skysweep::scene
