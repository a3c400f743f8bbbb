// SPDX-License-Identifier: Apache-2.0
// Sums run in double and in a fixed order, and are rounded once: the result does not depend on who asks.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "tiles/pyramid.h"

namespace skysweep::tiles {

namespace {

constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();

template <typename T>
using Quad = std::array<T, 4>;  // the 2 x 2 cells below one

template <typename T>
Quad<T> quad_below(const Array2d<T>& child, int column, int row) {
  return {child(2 * column, 2 * row), child(2 * column + 1, 2 * row), child(2 * column, 2 * row + 1),
          child(2 * column + 1, 2 * row + 1)};
}

float mean_of(const Quad<float>& values) {
  double sum = 0;
  int known = 0;
  for (const float value : values)
    if (!std::isnan(value)) sum += value, ++known;
  return known ? static_cast<float>(sum / known) : kNoData;
}

float highest_of(const Quad<float>& values) {
  float highest = kNoData;
  for (const float value : values)
    if (!std::isnan(value) && !(value <= highest)) highest = value;
  return highest;
}

float root_mean_square_of(const Quad<float>& values) {
  double sum = 0;
  int known = 0;
  for (const float value : values)
    if (!std::isnan(value)) sum += static_cast<double>(value) * value, ++known;
  return known ? static_cast<float>(std::sqrt(sum / known)) : kNoData;
}

Rgba8 mean_of(const Quad<Rgba8>& colors) {
  int r = 0, g = 0, b = 0, known = 0;
  for (const Rgba8& color : colors)
    if (color.a > 0) r += color.r, g += color.g, b += color.b, ++known;
  if (known == 0) return {};
  const auto rounded_mean = [&](int sum) { return static_cast<std::uint8_t>((2 * sum + known) / (2 * known)); };
  return {rounded_mean(r), rounded_mean(g), rounded_mean(b), 255};
}

std::uint8_t best_source_of(const Quad<std::uint8_t>& sources) {
  for (const CellSource source : {CellSource::measured, CellSource::filled, CellSource::planar})
    for (const std::uint8_t value : sources)
      if (value == static_cast<std::uint8_t>(source)) return value;
  return static_cast<std::uint8_t>(CellSource::none);
}

// Fills the quadrant of `parent` whose north-west cell is (column, row) from all of `child`.
template <typename T, typename Merge>
void merge_layer(const Array2d<T>& child, Array2d<T>& parent, int column, int row, Merge merge) {
  SKY_CHECK_EQ(child.width(), parent.width());
  SKY_CHECK_EQ(child.height(), parent.height());
  for (int y = 0; y < child.height() / 2; ++y)
    for (int x = 0; x < child.width() / 2; ++x) parent(column + x, row + y) = merge(quad_below(child, x, y));
}

}  // namespace

Tile empty_parent(int tile_cells) {
  SKY_CHECK_EQ(tile_cells % 2, 0);
  return {Array2d<float>(tile_cells, tile_cells, kNoData), Array2d<float>(tile_cells, tile_cells, kNoData),
          Array2d<Rgba8>(tile_cells, tile_cells), Array2d<float>(tile_cells, tile_cells, kNoData),
          Array2d<std::uint8_t>(tile_cells, tile_cells)};
}

void put_quadrant(Tile& parent, int quadrant, const Tile* child) {
  const int half = parent.dem.width() / 2;
  const int column = quadrant % 2 ? half : 0;
  const int row = quadrant < 2 ? half : 0;  // row 0 is north, the southern children come first
  const Tile nothing = child ? Tile{} : empty_parent(parent.dem.width());
  const Tile& from = child ? *child : nothing;
  merge_layer(from.dem, parent.dem, column, row, [](const Quad<float>& q) { return mean_of(q); });
  merge_layer(from.dem_max.empty() ? from.dem : from.dem_max, parent.dem_max, column, row, highest_of);
  merge_layer(from.color, parent.color, column, row, [](const Quad<Rgba8>& q) { return mean_of(q); });
  merge_layer(from.confidence, parent.confidence, column, row, root_mean_square_of);
  merge_layer(from.mask, parent.mask, column, row, best_source_of);
}

Tile merge_children(const std::array<const Tile*, 4>& children, int tile_cells) {
  Tile parent = empty_parent(tile_cells);
  for (int i = 0; i < 4; ++i)
    if (children[i]) put_quadrant(parent, i, children[i]);
  return parent;
}

}  // namespace skysweep::tiles
