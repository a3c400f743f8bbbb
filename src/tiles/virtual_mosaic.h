// SPDX-License-Identifier: Apache-2.0
// A layer of the map as one raster that holds no cells itself: a GDAL virtual dataset (VRT) over the tiles, with the
// coarser levels of the map as its overviews. Opened in QGIS it shows the map while it grows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tiles/tile_store.h"

namespace skysweep::tiles {

// Writes `path` for layer "dem" or "color" over the level-0 tiles `finest` (not empty) and, as overviews, over the
// tiles of higher levels among `parents`; the overviews' own files lie in the store, tiles/dem/l1.vrt. Tiles are named
// relative to the files, so that the project can be moved as a whole. Each file is replaced at once, and only if it
// changes; the same arguments give the same bytes. `digest`: of all tiles. Throws Error(failed) naming the file that
// cannot be written.
void write_virtual_mosaic(const TileStore& store, const std::string& layer, const std::vector<TileKey>& finest,
                          const std::vector<TileKey>& parents, const std::string& digest,
                          const std::filesystem::path& path);

// Removes it and its overviews, of a map that has no tile any more. Throws Error(failed).
void remove_virtual_mosaic(const TileStore& store, const std::string& layer, const std::filesystem::path& path);

}  // namespace skysweep::tiles
