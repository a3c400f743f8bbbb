// SPDX-License-Identifier: Apache-2.0
// A colour raster too large for the memory, written block by block.
#pragma once

#include <filesystem>
#include <functional>

#include "raster/virtual_raster.h"

namespace skysweep::raster {

// A GeoTIFF without georeference of width x height cells; `block` gives the cells of a window (at most 512 x 512). For
// files that VirtualRaster::mosaic reads again; not atomic. Throws Error(failed) naming the file, and Stopped.
void write_color_blocks(const std::filesystem::path& path, int width, int height,
                        const std::function<Array2d<Rgba8>(const Window&)>& block, const OnProgress& progress = {});

}  // namespace skysweep::raster
