// SPDX-License-Identifier: Apache-2.0
// How the cells of two orthophotos on one lattice correspond.
#pragma once

#include "raster/geotiff.h"

namespace skysweep::report {

struct CellOffset {
  int columns = 0, rows = 0;  // truth column and row + this = column and row of the orthophoto
};

// Throws Error(usage) unless both are in one CRS, with the same cell and corners a whole number of cells apart.
CellOffset lattice_offset(const raster::GeoReference& ortho, const raster::GeoReference& truth);

}  // namespace skysweep::report
