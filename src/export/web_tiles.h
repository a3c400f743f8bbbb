// SPDX-License-Identifier: Apache-2.0
// Tiles of 256 x 256 pixels in Web Mercator (EPSG:3857), as web maps take them. The finest zoom is cut from one raster,
// so neighbours fit pixel on pixel; every coarser zoom is made of its four children. Only a branch of the quadtree is
// in memory at a time. Tiles in which nothing is known are left out.
#pragma once

#include <optional>
#include <string>

#include "export/map_raster.h"
#include "export/tile_encoding.h"

namespace skysweep::exports {

inline constexpr int kWebTilePixels = 256;
inline constexpr int kFinestZoom = 26;

// Side of a pixel in units of EPSG:3857 (metres at the equator).
double web_cell(int zoom);
std::string web_crs();

struct ZoomRange {
  int min = 0;
  int max = 0;
};

// The finest zoom: the first whose pixels are not larger on the ground than the map's cells (by more than a tenth); the
// coarsest: the last at which the map, or the area of it, fits into one tile's size.
ZoomRange usual_zooms(const tiles::TileStore& store, const std::optional<Box2d>& area);

struct WebTileOptions {
  ZoomRange zooms;
  TileEncoding encoding = TileEncoding::png;
  int quality = 85;  // of jpeg and webp, 1 to 100
};

// A place for finished tiles. x counts eastwards from 180 degrees west, y southwards from the north (XYZ).
class TileSink {
 public:
  virtual ~TileSink() = default;
  virtual void put(int zoom, int x, int y, const std::string& bytes) = 0;
};

struct WebTileSummary {
  int tiles = 0;
  bool lost_no_data = false;  // a JPEG shows white where nothing is known
};

// `map` is on the lattice of the finest zoom: request CRS web_crs() and cell web_cell(zooms.max). Throws Stopped.
WebTileSummary write_web_tiles(const MapRaster& map, const WebTileOptions& options, TileSink& sink,
                               const raster::OnProgress& progress = {});

}  // namespace skysweep::exports
