// SPDX-License-Identifier: Apache-2.0
// A hillshade or relief of a large map, block by block. Shading needs metres on both axes, so it is done in the map's
// own reference system, before the picture is brought to another.
#pragma once

#include <filesystem>
#include <optional>

#include "raster/hillshade.h"
#include "raster/virtual_raster.h"

namespace skysweep::exports {

// Shades the window of `heights`, a relief if there is a span and a grey hillshade otherwise, into a GeoTIFF of RGBA
// cells with alpha 0 where there is no height. Each cell is what shading the whole map at once would give.
void write_shaded(const raster::VirtualRaster& heights, const raster::GeoReference& place, const raster::Window& window,
                  const std::optional<raster::HeightSpan>& span, const std::filesystem::path& path,
                  const raster::OnProgress& progress);

}  // namespace skysweep::exports
