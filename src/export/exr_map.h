// SPDX-License-Identifier: Apache-2.0
// The whole map as one OpenEXR file for renderers and compositing: a part each for "height", "sigma" (float, NaN where
// unknown), "colour" (R, G, B, A as half floats, linear light, premultiplied) and "mask" (unsigned integers), in tiles
// of 256 x 256.
#pragma once

#include "export/destination.h"
#include "export/map_raster.h"

namespace skysweep::exports {

struct MapParts {
  MapRaster height, sigma, colour, mask;  // on one lattice, of one window
};

// The request's layer does not count; a resampling other than nearest is not applied to the mask.
MapParts map_parts(const tiles::TileStore& store, MapRequest request, const std::filesystem::path& scratch);

// Every part carries the labels, the CRS (as `crsWkt`), the outer corner of its north-west cell (`west`, `north`) and
// the side of a cell (`cell`). Memory does not grow with the map. Throws Error(failed) naming the file, and Stopped.
void write_exr_map(const MapParts& parts, const Destination& to, const raster::OnProgress& progress = {});

}  // namespace skysweep::exports
