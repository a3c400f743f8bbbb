// SPDX-License-Identifier: Apache-2.0
// A measured surface beside the true one, cell by cell: what every figure about a surface is computed from.
#pragma once

#include "raster/geotiff.h"

namespace skysweep::report {

// All on the grid of the truth, all in metres, NaN where unknown.
struct HeightDifferences {
  raster::GeoReference grid;
  Array2d<float> truth;
  Array2d<float> measured;
  Array2d<float> dz;  // measured - true; NaN unless both are known
};

// If both rasters lie on one lattice, cell by cell; else the DSM is interpolated bilinearly at the centre of the
// truth's cell, which needs all four neighbours known. Throws Error(usage) if the CRSs differ.
HeightDifferences height_differences(const raster::Raster<float>& dsm, const raster::Raster<float>& truth);

// Throws Error(usage) naming `what` ("the mask") unless a raster of these properties lies on the grid of the truth.
void require_same_grid(const raster::GeoReference& georeference, int width, int height, const HeightDifferences& truth,
                       const char* what);

}  // namespace skysweep::report
