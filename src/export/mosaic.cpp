// SPDX-License-Identifier: Apache-2.0
#include "export/mosaic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "raster/cog.h"
#include "raster/digest.h"

namespace skysweep::exports {

namespace {

using tiles::TileKey;
using tiles::TileStore;

// Level-0 cells by their index in the unbounded lattice, x eastwards, y northwards; the ends are exclusive.
struct CellWindow {
  std::int64_t west = std::numeric_limits<std::int64_t>::max();
  std::int64_t south = std::numeric_limits<std::int64_t>::max();
  std::int64_t east = std::numeric_limits<std::int64_t>::min();
  std::int64_t north = std::numeric_limits<std::int64_t>::min();

  bool empty() const { return west >= east || south >= north; }
  bool contains(const CellWindow& o) const {
    return west <= o.west && south <= o.south && east >= o.east && north >= o.north;
  }
  bool intersects(const CellWindow& o) const {
    return west < o.east && o.west < east && south < o.north && o.south < north;
  }
  void extend(const CellWindow& o) {
    west = std::min(west, o.west), south = std::min(south, o.south);
    east = std::max(east, o.east), north = std::max(north, o.north);
  }
};

CellWindow window_of(TileKey key, int tile_cells) {
  const std::int64_t west = static_cast<std::int64_t>(key.x) * tile_cells;
  const std::int64_t south = static_cast<std::int64_t>(key.y) * tile_cells;
  return {west, south, west + tile_cells, south + tile_cells};
}

// Cells whose centres lie in the box.
CellWindow window_of(const Box2d& box, double cell_m) {
  const auto first_at_or_after = [&](double coordinate) {
    return static_cast<std::int64_t>(std::ceil(coordinate / cell_m - 0.5));
  };
  return {first_at_or_after(box.min.x), first_at_or_after(box.min.y), first_at_or_after(box.max.x),
          first_at_or_after(box.max.y)};
}

// The known cells of a tile.
CellWindow known_window(const TileStore& store, TileKey key) {
  const Array2d<std::uint8_t> mask = raster::read_class_raster(store.path(key, "mask")).values;
  const CellWindow tile = window_of(key, store.lattice().tile_cells);
  CellWindow known;
  for (int row = 0; row < mask.height(); ++row)
    for (int column = 0; column < mask.width(); ++column) {
      if (mask(column, row) == static_cast<std::uint8_t>(tiles::CellSource::none)) continue;
      const std::int64_t x = tile.west + column, y = tile.north - 1 - row;
      known.extend({x, y, x + 1, y + 1});
    }
  return known;
}

raster::CogKind kind_of(const std::string& layer) {
  if (layer == "color") return raster::CogKind::colors;
  if (layer == "mask") return raster::CogKind::classes;
  if (layer == "confidence") return raster::CogKind::deviations;
  SKY_CHECK_EQ(layer, "dem");
  return raster::CogKind::values;
}

std::vector<TileKey> tiles_in(const TileStore& store, const CellWindow& window) {
  std::vector<TileKey> keys = store.list(0);
  std::erase_if(keys, [&](TileKey key) { return !window.intersects(window_of(key, store.lattice().tile_cells)); });
  return keys;
}

std::string digest_of(const TileStore& store, const std::vector<TileKey>& keys) {
  raster::Digest digest;
  for (const TileKey key : keys) digest.add_field(key.name()).add_field(store.input_digest(key).value_or(""));
  return digest.hex();
}

}  // namespace

Box2d known_extent(const TileStore& store) {
  CellWindow known;
  for (const TileKey key : store.list(0))
    if (!known.contains(window_of(key, store.lattice().tile_cells))) known.extend(known_window(store, key));
  if (known.empty()) return {};
  const auto at = [&](std::int64_t cells) { return static_cast<double>(cells) * store.lattice().cell_m; };
  return {{at(known.west), at(known.south)}, {at(known.east), at(known.north)}};
}

void write_mosaic(const TileStore& store, const std::string& layer, const Box2d& extent,
                  const std::filesystem::path& path) {
  const tiles::Lattice& lattice = store.lattice();
  const CellWindow window = extent.empty() ? CellWindow{} : window_of(extent, lattice.cell_m);
  const std::vector<TileKey> keys = window.empty() ? std::vector<TileKey>() : tiles_in(store, window);
  if (keys.empty())
    throw bad_input("cannot write " + path.string() + ": the map has no tile in the area that was asked for");
  constexpr std::int64_t kMaxSide = std::numeric_limits<int>::max() - (1 << 20);
  if (window.east - window.west > kMaxSide || window.north - window.south > kMaxSide)
    throw bad_input("cannot write " + path.string() +
                    ": the area has too many cells for one file, ask for a part of it");

  raster::Cog cog;
  cog.kind = kind_of(layer);
  cog.width = static_cast<int>(window.east - window.west);
  cog.height = static_cast<int>(window.north - window.south);
  cog.georeference = {
      store.crs_wkt(),
      {static_cast<double>(window.west) * lattice.cell_m, static_cast<double>(window.north) * lattice.cell_m},
      lattice.cell_m};
  cog.labels = store.labels(layer, digest_of(store, keys));
  for (const TileKey key : keys) {
    const CellWindow tile = window_of(key, lattice.tile_cells);
    cog.sources.push_back({.path = store.path(key, layer),
                           .column = static_cast<int>(tile.west - window.west),
                           .row = static_cast<int>(window.north - tile.north),
                           .width = lattice.tile_cells,
                           .height = lattice.tile_cells});
  }
  raster::write_cog(path, cog);
}

}  // namespace skysweep::exports
