// SPDX-License-Identifier: Apache-2.0
// Pictures of a surface model, for looking at it: grey hillshade, and heights as colours under that shade. Cells
// without height come out as a light grey checkerboard. Write them with raster/photo.h write_image.
#pragma once

#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "raster/geotiff.h"

namespace skysweep::raster {

struct HillshadeOptions {
  double sun_azimuth_deg = 315;  // direction towards the sun, clockwise from north; north-west reads best as relief
  double sun_elevation_deg = 45;
  double exaggeration = 1;  // factor on heights
};

// Slopes by Horn 1981 (3 x 3 cells); a neighbour without height counts as level with the cell.
Array2d<Rgb8> hillshade(const Raster<float>& dem, const HillshadeOptions& options = {});

// Between which heights, metres, the colours of a relief are stretched.
struct HeightSpan {
  double low_m = 0;
  double high_m = 0;
};

// The 2 % and 98 % quantiles, so that a few outliers do not take all the colours; {0, 0} for no heights. The order of
// `heights_m`, which must not hold NaN, is changed.
HeightSpan usual_span(std::vector<float>& heights_m);

// Heights as colours from green over yellow and brown to white, times the hillshade.
Array2d<Rgb8> shaded_relief(const Raster<float>& dem, HeightSpan span, const HillshadeOptions& options = {});

}  // namespace skysweep::raster
