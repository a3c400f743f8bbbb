// SPDX-License-Identifier: Apache-2.0
// Pictures of a surface model, for looking at it: grey hillshade, and heights as colours under that shade. Cells
// without height come out as a light grey checkerboard. Write them with raster/photo.h write_image.
#pragma once

#include "core/array2d.h"
#include "core/color.h"
#include "raster/geotiff.h"

namespace skysweep::report {

struct HillshadeOptions {
  double sun_azimuth_deg = 315;  // direction towards the sun, clockwise from north; north-west reads best as relief
  double sun_elevation_deg = 45;
  double exaggeration = 1;  // factor on heights
};

// Slopes by Horn 1981 (3 x 3 cells); a neighbour without height counts as level with the cell.
Array2d<Rgb8> hillshade(const raster::Raster<float>& dem, const HillshadeOptions& options = {});

// Heights as colours from green over yellow and brown to white, stretched between the 2 % and 98 % quantiles so that a
// few outliers do not take all the colours, times the hillshade.
Array2d<Rgb8> shaded_relief(const raster::Raster<float>& dem, const HillshadeOptions& options = {});

}  // namespace skysweep::report
