// SPDX-License-Identifier: Apache-2.0
#include "render/map_window.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"

namespace skysweep::render {
namespace {

using tiles::TileKey;
using tiles::TileStore;

// Tiles of one level by their indices, ends included.
struct TileSpan {
  int level = 0, west = 0, south = 0, east = -1, north = -1;
  int columns() const { return east - west + 1; }
  int rows() const { return north - south + 1; }
  std::int64_t cells(int tile_cells) const {
    return std::int64_t{columns()} * rows() * tile_cells * static_cast<std::int64_t>(tile_cells);
  }
  TileSpan coarser() const { return {level + 1, west >> 1, south >> 1, east >> 1, north >> 1}; }
};

TileSpan finest_span(const TileStore& store, const std::optional<Box2d>& area) {
  TileSpan span;
  for (const TileKey key : store.list(0)) {
    const Box2d extent = store.lattice().extent(key);
    if (area && !(extent.min.x < area->max.x && extent.max.x > area->min.x && extent.min.y < area->max.y &&
                  extent.max.y > area->min.y))
      continue;
    if (span.columns() <= 0) span = {0, key.x, key.y, key.x, key.y};
    span.west = std::min(span.west, key.x), span.east = std::max(span.east, key.x);
    span.south = std::min(span.south, key.y), span.north = std::max(span.north, key.y);
  }
  if (span.columns() <= 0)
    throw bad_input(area ? "the map has no tile in the area of --aoi: choose another one."
                         : "the map has no tile yet: nothing is there to be rendered.");
  return span;
}

// The finest level that fits; the map's levels end where at most 2 x 2 tiles are left.
TileSpan fitting_span(const TileStore& store, const std::optional<Box2d>& area, std::int64_t most_cells) {
  TileSpan span = finest_span(store, area);
  const int tile_cells = store.lattice().tile_cells;
  while (span.cells(tile_cells) > most_cells) {
    if (store.list(span.level + 1).empty())
      throw Error(ErrorKind::memory_plan,
                  "the map does not fit at any of its levels: allow more with --memory, or ask for a part with --aoi.");
    span = span.coarser();
  }
  return span;
}

MapWindow empty_window(const TileStore& store, const TileSpan& span) {
  const int t = store.lattice().tile_cells;
  MapWindow window;
  window.level = span.level;
  window.cell_m = store.lattice().cell_size_m(span.level);
  window.north_west_m = store.lattice().north_west_corner({span.level, span.west, span.north});
  window.height_m = Array2d<float>(span.columns() * t, span.rows() * t, std::nanf(""));
  window.color = Array2d<Rgba8>(span.columns() * t, span.rows() * t);
  window.sigma_m = window.height_m;
  return window;
}

template <typename T>
void paste(const Array2d<T>& tile, int column, int row, Array2d<T>& into) {
  for (int y = 0; y < tile.height(); ++y)
    std::copy(tile.row(y), tile.row(y) + tile.width(), into.row(row + y) + column);
}

MapWindow joined_tiles(const TileStore& store, const TileSpan& span) {
  MapWindow window = empty_window(store, span);
  for (const TileKey key : store.list(span.level)) {
    if (key.x < span.west || key.x > span.east || key.y < span.south || key.y > span.north) continue;
    const std::optional<tiles::Tile> tile = store.read(key);
    if (!tile) continue;
    const int t = store.lattice().tile_cells, column = (key.x - span.west) * t, row = (span.north - key.y) * t;
    paste(tile->dem, column, row, window.height_m);
    paste(tile->color, column, row, window.color);
    paste(tile->confidence, column, row, window.sigma_m);
  }
  return window;
}

// The cells with heights whose centres lie in the area.
struct CellBox {
  int west = 1 << 30, north = 1 << 30, east = -1, south = -1;
  void extend(int x, int y) {
    west = std::min(west, x), east = std::max(east, x);
    north = std::min(north, y), south = std::max(south, y);
  }
};

MapWindow cut(const MapWindow& window, const std::optional<Box2d>& area) {
  CellBox known;
  for (int y = 0; y < window.height_m.height(); ++y)
    for (int x = 0; x < window.height_m.width(); ++x) {
      const Vec2d center{window.north_west_m.x + (x + 0.5) * window.cell_m,
                         window.north_west_m.y - (y + 0.5) * window.cell_m};
      if (std::isfinite(window.height_m(x, y)) && (!area || area->contains(center))) known.extend(x, y);
    }
  if (known.east < 0) throw bad_input("no height of the map is known there: nothing is there to be rendered.");
  const int width = known.east - known.west + 1, height = known.south - known.north + 1;
  return {window.level,
          {window.north_west_m.x + known.west * window.cell_m, window.north_west_m.y - known.north * window.cell_m},
          window.cell_m,
          crop(window.height_m, known.west, known.north, width, height),
          crop(window.color, known.west, known.north, width, height),
          crop(window.sigma_m, known.west, known.north, width, height)};
}

}  // namespace

MapWindow read_map_window(const TileStore& store, const std::optional<Box2d>& area, std::int64_t most_cells) {
  return cut(joined_tiles(store, fitting_span(store, area, most_cells)), area);
}

}  // namespace skysweep::render
