// SPDX-License-Identifier: Apache-2.0
// How well an orthophoto lies on a true one: shifts of small blocks found by normalised cross-correlation over the
// cells that have colours in both, and the difference in colour where nothing is shifted.
#pragma once

#include <cstdint>

#include "raster/geotiff.h"

namespace skysweep::report {

struct RegistrationOptions {
  int block_cells = 64;          // side of a block
  int search_cells = 3;          // largest shift that can be found, in x and in y
  double min_deviation = 3;      // a block whose luminance deviates less (grey levels) has no texture to hold on to
  double min_known_share = 0.5;  // of a block's cells, with colours in both at every shift that is tried
  double min_correlation = 0.5;  // below this at the best shift the block shows something else
};

struct Registration {
  int blocks = 0;       // blocks in the common area
  int blocks_used = 0;  // with enough colours, texture, and a clear correlation peak inside the search
  // NaN where no block could be used. Shift = where the content lies in the orthophoto minus where it truly lies.
  double median_shift_cells = 0;    // of the shifts' lengths
  double median_shift_x_cells = 0;  // east
  double median_shift_y_cells = 0;  // north
  // Absolute difference of colour, mean of the three channels, grey levels; NaN where no cell has both colours.
  double median_color_difference = 0;
  double mean_color_difference = 0;

  double used_share() const { return blocks > 0 ? static_cast<double>(blocks_used) / blocks : 0; }
};

// Both on one lattice (same cell, corners a whole number of cells apart) and in one CRS; throws Error(usage) if not.
Registration compare_orthophotos(const raster::Raster<Rgba8>& ortho, const raster::Raster<Rgba8>& truth,
                                 const RegistrationOptions& options = {});

}  // namespace skysweep::report
