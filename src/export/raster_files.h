// SPDX-License-Identifier: Apache-2.0
// An exported layer as raster files of GIS: one Cloud Optimized GeoTIFF, a folder of GeoTIFF tiles, an ESRI ASCII grid,
// or a list of points as text. All stream: memory does not grow with the map.
#pragma once

#include <filesystem>

#include "export/destination.h"
#include "export/map_raster.h"

namespace skysweep::exports {

void write_cog(const MapRaster& map, const Destination& to, const raster::OnProgress& progress = {});

struct TileSize {
  int cells = 1024;  // along a side, without the overlap
  int overlap = 0;   // cells that a tile shows of each neighbour
};

// x<i>_y<j>.tif: the tile whose south-west corner lies i tiles east and j tiles north of the origin of the CRS, so that
// exports of different windows name the same tile alike. Tiles of which nothing is known are left out, tiles at the
// edge of the window are smaller. labels.json describes them all. Returns the number of tiles.
int write_geotiff_tiles(const MapRaster& map, const TileSize& size, const Destination& to,
                        const raster::OnProgress& progress = {});

// Heights, sigma or codes with four decimals, -9999 where there is none, and beside it the CRS (.prj) and the labels
// (.aux.xml), which GDAL and QGIS read. Throws Error(usage) for colours.
void write_ascii_grid(const MapRaster& map, const Destination& to, const raster::OnProgress& progress = {});

// A line "x y z" for each known cell, from north-west, eastwards and then southwards, with the CRS and labels beside
// it. Throws Error(usage) for colours. Returns the number of points.
std::int64_t write_xyz_text(const MapRaster& map, const Destination& to, const raster::OnProgress& progress = {});

}  // namespace skysweep::exports
