// SPDX-License-Identifier: Apache-2.0
#include "render/height_field.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace skysweep::render {
namespace {

struct Cell {
  int x, y;
};

template <typename Visit>
void for_neighbours(const Array2d<float>& cells, Cell cell, Visit visit) {
  constexpr Cell kSides[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const Cell side : kSides)
    if (const Cell next{cell.x + side.x, cell.y + side.y}; cells.contains(next.x, next.y)) visit(next);
}

// Known where there is a height; of the others outside what can be reached from the border.
Array2d<CellKind> kinds_of(const Array2d<float>& height_m) {
  const int width = height_m.width(), height = height_m.height();
  Array2d<CellKind> kinds(width, height, CellKind::hole);
  std::vector<Cell> open;
  const auto reach = [&](Cell cell) {
    if (kinds(cell.x, cell.y) != CellKind::hole) return;
    kinds(cell.x, cell.y) = CellKind::outside;
    open.push_back(cell);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (std::isfinite(height_m(x, y))) kinds(x, y) = CellKind::known;
  for (int x = 0; x < width; ++x) reach({x, 0}), reach({x, height - 1});
  for (int y = 0; y < height; ++y) reach({0, y}), reach({width - 1, y});
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    for_neighbours(height_m, cell, reach);
  }
  return kinds;
}

// Stand-ins grow inwards from the rim of a hole, ring by ring: each cell gets the mean of its neighbours with heights.
// A ring is worked out before any of it is written, so the result does not depend on the order.
void fill_holes(HeightField& field) {
  std::vector<Cell> rim;
  Array2d<std::uint8_t> queued(field.height_m.width(), field.height_m.height(), 0);
  const auto has_height = [&](Cell c) { return std::isfinite(field.height_m(c.x, c.y)); };
  const auto queue = [&](Cell c, std::vector<Cell>& into) {
    if (field.kind(c.x, c.y) != CellKind::hole || has_height(c) || queued(c.x, c.y)) return;
    queued(c.x, c.y) = 1;
    into.push_back(c);
  };
  for (int y = 0; y < field.kind.height(); ++y)
    for (int x = 0; x < field.kind.width(); ++x)
      if (field.kind(x, y) == CellKind::known) for_neighbours(field.height_m, {x, y}, [&](Cell c) { queue(c, rim); });
  while (!rim.empty()) {
    std::vector<float> heights;
    heights.reserve(rim.size());
    for (const Cell cell : rim) {
      double sum = 0;
      int count = 0;
      for_neighbours(field.height_m, cell, [&](Cell c) {
        if (has_height(c)) sum += field.height_m(c.x, c.y), ++count;
      });
      heights.push_back(static_cast<float>(sum / count));
    }
    for (std::size_t i = 0; i < rim.size(); ++i) field.height_m(rim[i].x, rim[i].y) = heights[i];
    std::vector<Cell> next;
    for (const Cell cell : rim) for_neighbours(field.height_m, cell, [&](Cell c) { queue(c, next); });
    rim = std::move(next);
  }
}

}  // namespace

HeightField make_height_field(Vec2d north_west_m, double cell_m, Array2d<float> height_m) {
  HeightField field{north_west_m, cell_m, std::move(height_m), {}};
  field.kind = kinds_of(field.height_m);
  fill_holes(field);
  return field;
}

Box3d bounds(const HeightField& field, double share) {
  Box3d box;
  std::vector<float> heights;
  for (int y = 0; y < field.kind.height(); ++y)
    for (int x = 0; x < field.kind.width(); ++x) {
      if (field.kind(x, y) != CellKind::known) continue;
      box.extend(field.map_from_cells({1. * x, 1. * y, 0}));
      box.extend(field.map_from_cells({x + 1., y + 1., 0}));
      heights.push_back(field.height_m(x, y));
    }
  if (heights.empty()) return box;
  const auto quantile = [&](double q) {
    const auto at = heights.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), at, heights.end());
    return static_cast<double>(*at);
  };
  box.min.z = quantile(share);
  box.max.z = quantile(1 - share);
  return box;
}

HeightField exaggerated(HeightField field, double factor, double base_m) {
  for (float& height : field.height_m) height = static_cast<float>(base_m + factor * (height - base_m));
  return field;
}

}  // namespace skysweep::render
