// SPDX-License-Identifier: Apache-2.0
#include "export/web_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "export/mosaic.h"
#include "raster/crs.h"
#include "raster/picture.h"

namespace skysweep::exports {

namespace {

constexpr double kHalfWorld = 20037508.342789244;  // pi times the radius of the sphere, 6378137 m

// Tiles of a zoom that show some of the cells; ends are exclusive.
struct TileRange {
  int west = 0, north = 0, east = 0, south = 0;
};

std::int64_t half_world_cells(int zoom) { return (std::int64_t{kWebTilePixels} << zoom) / 2; }

TileRange tiles_of(const CellRange& cells, int zoom) {
  const std::int64_t half = half_world_cells(zoom);
  const auto tile = [&](std::int64_t cells_from_corner) {
    return static_cast<int>(std::clamp<std::int64_t>(cells_from_corner, 0, 2 * half - 1) / kWebTilePixels);
  };
  return {tile(cells.west + half), tile(half - cells.north), tile(cells.east - 1 + half) + 1,
          tile(half - cells.south - 1) + 1};
}

CellRange cells_of_tile(int zoom, int x, int y) {
  const std::int64_t half = half_world_cells(zoom);
  const std::int64_t west = std::int64_t{kWebTilePixels} * x - half, north = half - std::int64_t{kWebTilePixels} * y;
  return {west, north - kWebTilePixels, west + kWebTilePixels, north};
}

bool is_known(float z) { return std::isfinite(z); }
bool is_known(Rgba8 c) { return c.a > 0; }
template <typename T>
T no_data();
template <>
float no_data() {
  return std::numeric_limits<float>::quiet_NaN();
}
template <>
Rgba8 no_data() {
  return {};
}

template <typename T>
class Pyramid {
 public:
  Pyramid(const MapRaster& map, const WebTileOptions& options, TileSink& sink, const raster::OnProgress& progress)
      : map_(map),
        options_(options),
        sink_(sink),
        progress_(progress),
        finest_(tiles_of(map.cells, options.zooms.max)) {
    total_ = static_cast<double>(finest_.east - finest_.west) * (finest_.south - finest_.north);
  }

  WebTileSummary write() {
    const int shift = options_.zooms.max - options_.zooms.min;
    for (int y = finest_.north >> shift; y <= (finest_.south - 1) >> shift; ++y)
      for (int x = finest_.west >> shift; x <= (finest_.east - 1) >> shift; ++x) branch(options_.zooms.min, x, y);
    return summary_;
  }

 private:
  // Writes the tile and all below it; nothing if nothing is known there.
  std::optional<Array2d<T>> branch(int zoom, int x, int y) {
    const int shift = options_.zooms.max - zoom;
    if (((x + 1) << shift) <= finest_.west || (x << shift) >= finest_.east || ((y + 1) << shift) <= finest_.north ||
        (y << shift) >= finest_.south)
      return std::nullopt;
    std::optional<Array2d<T>> tile = zoom == options_.zooms.max ? finest(x, y) : from_children(zoom, x, y);
    if (tile) {
      sink_.put(zoom, x, y, encoded(*tile, zoom, x, y));
      ++summary_.tiles;
    }
    return tile;
  }

  std::optional<Array2d<T>> finest(int x, int y) {
    if (progress_ && !progress_(++done_ / total_)) throw raster::Stopped{};
    Array2d<T> cells = read(map_.window_of(cells_of_tile(options_.zooms.max, x, y)));
    if (std::none_of(cells.begin(), cells.end(), [](T cell) { return is_known(cell); })) return std::nullopt;
    return cells;
  }

  std::optional<Array2d<T>> from_children(int zoom, int x, int y) {
    constexpr int kHalf = kWebTilePixels / 2;
    std::optional<Array2d<T>> tile;
    for (int dy = 0; dy < 2; ++dy)
      for (int dx = 0; dx < 2; ++dx) {
        const std::optional<Array2d<T>> child = branch(zoom + 1, 2 * x + dx, 2 * y + dy);
        if (!child) continue;
        if (!tile) tile.emplace(kWebTilePixels, kWebTilePixels, no_data<T>());
        const Array2d<T> quarter = halved(*child);
        for (int row = 0; row < kHalf; ++row)
          std::copy_n(quarter.row(row), kHalf, tile->row(dy * kHalf + row) + dx * kHalf);
      }
    return tile;
  }

  Array2d<T> read(const raster::Window& window) const {
    if constexpr (std::is_same_v<T, float>)
      return map_.whole.floats(window);
    else
      return map_.whole.colors(window);
  }

  std::string encoded(const Array2d<float>& cells, int zoom, int x, int y) {
    if (options_.encoding != TileEncoding::float32)
      return raster::picture_bytes(packed_heights(cells, options_.encoding), raster::PictureFormat::png, 0);
    const double cell = web_cell(zoom);
    const CellRange range = cells_of_tile(zoom, x, y);
    const raster::GeoReference place{
        map_.crs_wkt, {static_cast<double>(range.west) * cell, static_cast<double>(range.north) * cell}, cell};
    return raster::geotiff_bytes({cells, place, map_.labels});
  }

  std::string encoded(const Array2d<Rgba8>& cells, int, int, int) {
    if (options_.encoding != TileEncoding::jpeg) {
      const bool webp = options_.encoding == TileEncoding::webp;
      return raster::picture_bytes(cells, webp ? raster::PictureFormat::webp : raster::PictureFormat::png,
                                   options_.quality);
    }
    Array2d<Rgba8> on_white = cells;
    for (Rgba8& c : on_white) {
      summary_.lost_no_data |= c.a == 0;
      const auto over = [&](int v) { return static_cast<std::uint8_t>((v * c.a + 255 * (255 - c.a) + 127) / 255); };
      c = {over(c.r), over(c.g), over(c.b), 255};
    }
    return raster::picture_bytes(on_white, raster::PictureFormat::jpeg, options_.quality);
  }

  const MapRaster& map_;
  const WebTileOptions& options_;
  TileSink& sink_;
  const raster::OnProgress& progress_;
  const TileRange finest_;
  double total_ = 1, done_ = 0;
  WebTileSummary summary_;
};

}  // namespace

double web_cell(int zoom) { return std::ldexp(kHalfWorld / (kWebTilePixels / 2), -zoom); }

std::string web_crs() { return raster::crs_from_user_input("EPSG:3857"); }

ZoomRange usual_zooms(const tiles::TileStore& store, const std::optional<Box2d>& area) {
  const Box2d extent = area ? *area : known_extent(store);
  const std::string crs = web_crs();
  const double map_cell = store.lattice().cell_m * units_per_metre(store, crs, extent);
  const Box2d there = raster::transformed_extent(store.crs_wkt(), crs, extent);
  const double side = std::max(there.width(), there.height());
  ZoomRange zooms{0, 1};
  while (zooms.max < kFinestZoom && web_cell(zooms.max) > 1.1 * map_cell) ++zooms.max;
  while (zooms.min < zooms.max && side <= web_cell(zooms.min + 1) * kWebTilePixels) ++zooms.min;
  return zooms;
}

WebTileSummary write_web_tiles(const MapRaster& map, const WebTileOptions& options, TileSink& sink,
                               const raster::OnProgress& progress) {
  SKY_CHECK(options.zooms.max >= 1 && options.zooms.min <= options.zooms.max && options.zooms.max <= kFinestZoom);
  SKY_CHECK_EQ(map.cell, web_cell(options.zooms.max));
  if (is_picture(options.encoding)) return Pyramid<Rgba8>(map, options, sink, progress).write();
  return Pyramid<float>(map, options, sink, progress).write();
}

}  // namespace skysweep::exports
