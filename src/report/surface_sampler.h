// SPDX-License-Identifier: Apache-2.0
// Values of a raster anywhere between its cell centres.
#pragma once

#include "core/vec.h"
#include "raster/geotiff.h"

namespace skysweep::report {

// Bilinear interpolation of a raster of heights (or of sigmas). Keeps a reference to the raster.
class SurfaceSampler {
 public:
  explicit SurfaceSampler(const raster::Raster<float>& surface) : surface_(surface) {}

  // At a position in the raster's CRS. NaN outside and beside holes; on a cell centre only that cell counts.
  double at(Vec2d p) const;

 private:
  const raster::Raster<float>& surface_;
};

// The raster at every cell centre of a grid in the same CRS: cell by cell where both lie on one lattice.
Array2d<float> sampled_on_grid(const raster::Raster<float>& surface, const raster::GeoReference& grid, int width,
                               int height);

}  // namespace skysweep::report
