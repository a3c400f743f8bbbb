// SPDX-License-Identifier: Apache-2.0
#include "export/shading.h"

#include <algorithm>
#include <cmath>

#include "raster/color_blocks.h"

namespace skysweep::exports {

namespace {

// The window with a border of one cell, whose heights the slopes at the window's edge need.
raster::Window with_border(const raster::Window& w, int width, int height) {
  const int west = std::max(0, w.column - 1), north = std::max(0, w.row - 1);
  const int east = std::min(width, w.column + w.width + 1), south = std::min(height, w.row + w.height + 1);
  return {west, north, east - west, south - north};
}

}  // namespace

void write_shaded(const raster::VirtualRaster& heights, const raster::GeoReference& place, const raster::Window& window,
                  const std::optional<raster::HeightSpan>& span, const std::filesystem::path& path,
                  const raster::OnProgress& progress) {
  const auto shaded_block = [&](const raster::Window& in_window) {
    const raster::Window block{window.column + in_window.column, window.row + in_window.row, in_window.width,
                               in_window.height};
    const raster::Window wide = with_border(block, heights.width(), heights.height());
    const raster::Raster<float> dem{heights.floats(wide), place, {}};
    const Array2d<Rgb8> light = span ? raster::shaded_relief(dem, *span) : raster::hillshade(dem);
    Array2d<Rgba8> out(block.width, block.height);
    for (int row = 0; row < block.height; ++row)
      for (int column = 0; column < block.width; ++column) {
        const int x = column + block.column - wide.column, y = row + block.row - wide.row;
        if (!std::isfinite(dem.values(x, y))) continue;
        const Rgb8 c = light(x, y);
        out(column, row) = {c.r, c.g, c.b, 255};
      }
    return out;
  };
  raster::write_color_blocks(path, window.width, window.height, shaded_block, progress);
}

}  // namespace skysweep::exports
