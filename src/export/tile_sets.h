// SPDX-License-Identifier: Apache-2.0
// Web tiles as a folder of files, or as one MBTiles file (SQLite, MBTiles 1.3). Both say what they hold: tilejson.json
// and labels.json in the folder, the table `metadata` in the file.
#pragma once

#include "export/destination.h"
#include "export/web_tiles.h"

namespace skysweep::exports {

enum class TileScheme {
  xyz,  // y counts southwards from the north: web maps, QGIS
  tms,  // y counts northwards from the south
};

// <zoom>/<x>/<y>.<extension>
WebTileSummary write_tile_folder(const MapRaster& map, const WebTileOptions& options, TileScheme scheme,
                                 const Destination& to, const raster::OnProgress& progress = {});

// Throws Error(usage) for float32, which MBTiles does not know.
WebTileSummary write_mbtiles(const MapRaster& map, const WebTileOptions& options, const Destination& to,
                             const raster::OnProgress& progress = {});

}  // namespace skysweep::exports
