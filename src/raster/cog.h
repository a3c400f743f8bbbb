// SPDX-License-Identifier: Apache-2.0
// One Cloud Optimized GeoTIFF made of many GeoTIFF files that lie on one lattice of cells. It holds overviews, is read
// from a web server piece by piece, and needs memory for a few blocks only, however large it is.
#pragma once

#include <filesystem>
#include <vector>

#include "raster/geotiff.h"

namespace skysweep::raster {

// A file of the mosaic and the cell of the mosaic (column from the west, row from the north) on which its north-west
// cell lies; it may stick out on any side.
struct CogSource {
  std::filesystem::path path;
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

enum class CogKind {
  values,      // float32, no-data NaN; overviews hold means
  deviations,  // float32, no-data NaN; overviews hold root mean squares
  colors,      // RGBA; overviews hold means of the known colours
  classes,     // uint8, no-data 0; overviews hold the most frequent class
};

struct Cog {
  CogKind kind = CogKind::values;
  int width = 0;
  int height = 0;
  GeoReference georeference;
  Labels labels;
  std::vector<CogSource> sources;  // must not overlap; what none covers is no-data
};

// Atomic, without time stamps: the same sources give the same bytes. Throws Error(failed) naming `path` if it cannot be
// written and Error(bad_input) naming the source that cannot be read.
void write_cog(const std::filesystem::path& path, const Cog& cog);

}  // namespace skysweep::raster
