// SPDX-License-Identifier: Apache-2.0
// Tiles with holes, reproducible from their key.
#pragma once

#include <limits>

#include "core/random.h"
#include "tiles/tile_store.h"

namespace skysweep::tiles {

inline Tile random_tile(TileKey key, int cells, std::uint64_t seed = 0) {
  Random random(key.packed() ^ mix64(seed));
  constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  Tile tile{Array2d<float>(cells, cells, kNoData),
            {},
            Array2d<Rgba8>(cells, cells),
            Array2d<float>(cells, cells, kNoData),
            Array2d<std::uint8_t>(cells, cells)};
  for (std::size_t i = 0; i < tile.dem.size(); ++i) {
    tile.mask.data()[i] = static_cast<std::uint8_t>(random.below(4));
    const auto source = static_cast<CellSource>(tile.mask.data()[i]);
    if (source == CellSource::none) continue;
    const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
    tile.color.data()[i] = {byte(), byte(), byte(), 255};
    if (source == CellSource::planar) continue;
    tile.dem.data()[i] = static_cast<float>(random.uniform(-400, 9000));
    tile.confidence.data()[i] = static_cast<float>(random.uniform(0.01, 2));
  }
  return tile;
}

}  // namespace skysweep::tiles
