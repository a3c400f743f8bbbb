// SPDX-License-Identifier: Apache-2.0
// A layer of the map as one file: the level-0 tiles joined into a Cloud Optimized GeoTIFF with the project's CRS,
// units, vertical reference and a digest of all that it was made of. All layers of a map written with the same extent
// lie cell on cell. (The namespace is not called like the folder, because `export` is a keyword.)
#pragma once

#include <filesystem>
#include <string>

#include "core/box.h"
#include "tiles/tile_store.h"

namespace skysweep::exports {

// The smallest rectangle of level-0 cells with everything in it that is known (height or colour), from the mask layer;
// an empty box if nothing is known. Throws Error(bad_input) naming a damaged tile.
Box2d known_extent(const tiles::TileStore& store);

// Writes one layer ("dem", "color", "confidence" or "mask"): the cells whose centres lie in `extent`, which is
// known_extent() or an area of interest. Atomic; equal tiles give equal bytes; memory does not grow with the map.
// Throws Error(bad_input) if no tile lies in the extent or a tile is damaged, and Error(failed) if the file cannot be
// written.
void write_mosaic(const tiles::TileStore& store, const std::string& layer, const Box2d& extent,
                  const std::filesystem::path& path);

}  // namespace skysweep::exports
