// SPDX-License-Identifier: Apache-2.0
// A layer of the map as it is to be exported: any cell, reference system, window and resampling. The lattice of an
// export is anchored in the origin of its reference system: cells lie between whole multiples of their size, so exports
// made at different times or of different windows lie cell on cell and agree in every bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "raster/hillshade.h"
#include "raster/virtual_raster.h"
#include "tiles/tile_store.h"

namespace skysweep::exports {

enum class Layer { dsm, ortho, confidence, mask, hillshade, relief };

// "dsm", "ortho", ... in the order of the enumeration.
const std::vector<std::string>& layer_names();
std::string to_string(Layer layer);

struct MapRequest {
  Layer layer = Layer::dsm;
  std::optional<Box2d> area = {};                        // in the map's CRS; without it all that is known
  std::optional<std::string> crs_wkt = {};               // from output_crs_from_user_input; without it the map's own
  std::optional<double> cell = {};                       // in units of the CRS; without it as fine as the map
  std::optional<raster::Resampling> resampling = {};     // bilinear without it; the mask is always nearest
  std::optional<raster::HeightSpan> relief_span_m = {};  // the usual one without it
};

// The lattice of an export: cell (0, 0) has its south-west corner in the origin of the CRS, x grows eastwards and y
// northwards, ends are exclusive.
struct CellRange {
  std::int64_t west = 0, south = 0, east = 0, north = 0;
  std::int64_t width() const { return east - west; }
  std::int64_t height() const { return north - south; }
  bool empty() const { return west >= east || south >= north; }
};

struct MapRaster {
  raster::VirtualRaster whole;  // of the whole map, and somewhat more
  CellRange whole_cells;        // the cells that `whole` covers
  CellRange cells;              // the cells asked for, inside of `whole_cells`
  std::string crs_wkt;
  double cell = 0;    // units of the CRS
  double cell_m = 0;  // about, on the ground
  raster::Labels labels;

  raster::Window window_of(const CellRange& range) const;
  // The cells asked for.
  raster::VirtualRaster part() const { return whole.window(window_of(cells)); }
};

// `scratch` is a folder for a shaded picture, which has to be written before it can be resampled; it must outlive the
// result. Coarse cells come from the map's coarser levels. Throws Error(usage) for a request that cannot be met,
// Error(bad_input) for an empty area or a damaged tile.
MapRaster map_raster(const tiles::TileStore& store, const MapRequest& request, const std::filesystem::path& scratch,
                     const raster::OnProgress& progress = {});

// The cell of an export without one in the request: as large as the map's on the ground, to two digits.
double usual_cell(const tiles::TileStore& store, const std::string& crs_wkt, const Box2d& extent);

// How many units of the CRS a metre of the map is at the middle of the extent.
double units_per_metre(const tiles::TileStore& store, const std::string& crs_wkt, const Box2d& extent);

}  // namespace skysweep::exports
