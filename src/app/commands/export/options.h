// SPDX-License-Identifier: Apache-2.0
// What `skysweep export` was asked for, as typed and as understood.
#pragma once

#include <optional>
#include <string>

#include "export/map_raster.h"
#include "export/raster_files.h"
#include "export/tile_sets.h"

namespace skysweep::app {

enum class ExportFormat { cog, geotiff_tiles, web_tiles, mbtiles, ascii_grid, xyz_text, exr };

struct ExportOptions {
  std::string project, output, format;
  std::optional<std::string> layer, area, crs, resampling, relief_range;
  std::optional<double> cell;
  std::optional<int> tile_cells, overlap, quality;
  std::optional<std::string> encoding, zoom, scheme;
  bool overwrite = false;
  bool json_log = false;

  // All of these throw Error(usage) with a sentence that names the option, and for an unknown word the nearest known
  // one.
  ExportFormat chosen_format() const;
  // Throws if an option was given that has no effect with the format.
  void check() const;
  exports::MapRequest request(const std::string& map_crs) const;
  exports::TileSize tile_size() const;
  // Of web tiles: on the lattice of the finest zoom.
  exports::MapRequest web_request(const tiles::TileStore& store, const exports::WebTileOptions& web) const;
  exports::WebTileOptions web_tiles(const tiles::TileStore& store) const;
  exports::TileScheme tile_scheme() const;
};

}  // namespace skysweep::app
