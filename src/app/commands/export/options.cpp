// SPDX-License-Identifier: Apache-2.0
#include "app/commands/export/options.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <vector>

#include "app/option_values.h"
#include "core/error.h"
#include "raster/crs.h"

namespace skysweep::app {
namespace {

using Formats = std::set<ExportFormat>;

// In the order of ExportFormat.
const std::vector<std::string> kFormats = {"cog",        "geotiff-tiles", "web-tiles", "mbtiles",
                                           "ascii-grid", "xyz-text",      "exr"};
const std::vector<std::string> kSchemes = {"xyz", "tms"};
const std::vector<std::string> kResamplings = {"nearest", "bilinear", "cubic", "average"};

// "18" or "14-20".
exports::ZoomRange parse_zooms(const std::string& text) {
  exports::ZoomRange zooms;
  const char* const end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data(), end, zooms.min);
  bool good = error == std::errc();
  zooms.max = zooms.min;
  if (good && at < end && *at == '-') {
    const auto second = std::from_chars(at + 1, end, zooms.max);
    good = second.ec == std::errc();
    at = second.ptr;
  }
  if (!good || at != end || zooms.min < 0 || zooms.max < zooms.min || zooms.max < 1 || zooms.max > exports::kFinestZoom)
    throw usage_error("--zoom takes A-B or one number, from 0 to " + std::to_string(exports::kFinestZoom) +
                      ", the last at least 1, not '" + text + "'.");
  return zooms;
}

// An option that only some formats know.
struct Limited {
  const char* name;
  bool given;
  Formats formats;
};

}  // namespace

ExportFormat ExportOptions::chosen_format() const {
  return static_cast<ExportFormat>(index_of_word(format, kFormats, "--format"));
}

void ExportOptions::check() const {
  using enum ExportFormat;
  const Formats on_a_free_lattice = {cog, geotiff_tiles, ascii_grid, xyz_text, exr};
  const std::vector<Limited> limited = {
      {"--layer", layer.has_value(), {cog, geotiff_tiles, web_tiles, mbtiles, ascii_grid, xyz_text}},
      {"--crs", crs.has_value(), on_a_free_lattice},
      {"--cell", cell.has_value(), on_a_free_lattice},
      {"--relief-range", relief_range.has_value(), {cog, geotiff_tiles, web_tiles, mbtiles}},
      {"--tile-cells", tile_cells.has_value(), {geotiff_tiles}},
      {"--overlap", overlap.has_value(), {geotiff_tiles}},
      {"--encoding", encoding.has_value(), {web_tiles, mbtiles}},
      {"--quality", quality.has_value(), {web_tiles, mbtiles}},
      {"--zoom", zoom.has_value(), {web_tiles, mbtiles}},
      {"--scheme", scheme.has_value(), {web_tiles}},
  };
  const ExportFormat chosen = chosen_format();
  for (const Limited& option : limited)
    if (option.given && !option.formats.contains(chosen))
      throw usage_error(std::string(option.name) + " has no effect with --format " + format + ": leave it away.");
}

exports::MapRequest ExportOptions::request(const std::string& map_crs) const {
  exports::MapRequest request;
  if (layer) request.layer = static_cast<exports::Layer>(index_of_word(*layer, exports::layer_names(), "--layer"));
  if (area) request.area = parse_area(*area);
  if (crs) {
    if (raster::is_local_crs(map_crs))
      throw usage_error(
          "--crs cannot be met: the map lies in a local metric frame that has no place on Earth. Make it "
          "with `skysweep run --crs` (and --origin), or leave --crs away.");
    request.crs_wkt = raster::output_crs_from_user_input(*crs, map_crs);
  }
  request.cell = cell;
  if (resampling)
    request.resampling = static_cast<raster::Resampling>(index_of_word(*resampling, kResamplings, "--resampling"));
  if (relief_range) {
    const Vec2d range = parse_pair(*relief_range, "--relief-range", "LOW,HIGH in metres");
    request.relief_span_m = raster::HeightSpan{range.x, range.y};
  }
  return request;
}

exports::TileSize ExportOptions::tile_size() const {
  exports::TileSize size;
  size.cells = tile_cells.value_or(size.cells);
  size.overlap = overlap.value_or(size.overlap);
  if (size.cells < 16 || size.cells > 8192) throw usage_error("--tile-cells takes a number from 16 to 8192.");
  if (size.overlap < 0 || size.overlap > size.cells / 2)
    throw usage_error("--overlap takes a number of cells from 0 to half of --tile-cells.");
  return size;
}

exports::WebTileOptions ExportOptions::web_tiles(const tiles::TileStore& store) const {
  using enum exports::TileEncoding;
  using exports::Layer;
  if (raster::is_local_crs(store.crs_wkt()))
    throw usage_error(
        "web tiles need a place on Earth, but the map lies in a local metric frame: make it with `skysweep "
        "run --crs` (and --origin), or export another --format, e.g. geotiff-tiles.");
  const Layer chosen = request(store.crs_wkt()).layer;
  if (chosen == Layer::mask)
    throw usage_error("the mask holds codes, which web tiles would mix: choose another --layer, or --format cog.");
  const bool heights = chosen == Layer::dsm, numbers = heights || chosen == Layer::confidence;
  exports::WebTileOptions web;
  web.encoding = heights ? terrarium : numbers ? float32 : png;
  if (encoding)
    web.encoding =
        static_cast<exports::TileEncoding>(index_of_word(*encoding, exports::encoding_names(), "--encoding"));
  if (numbers && exports::is_picture(web.encoding))
    throw usage_error("--encoding " + *encoding + " is for pictures: for " + exports::to_string(chosen) +
                      " take float32" + (heights ? ", terrarium or terrain-rgb" : "") +
                      ", or choose --layer relief or hillshade.");
  if (!numbers && !exports::is_picture(web.encoding))
    throw usage_error("--encoding " + *encoding + " is for heights: for " + exports::to_string(chosen) +
                      " take png, webp or jpeg.");
  if (chosen == Layer::confidence && web.encoding != float32)
    throw usage_error("--encoding " + *encoding + " is for heights: for confidence take float32.");
  if (quality) {
    if (web.encoding != webp && web.encoding != jpeg)
      throw usage_error("--quality has an effect with --encoding webp and jpeg only: leave it away.");
    if (*quality < 1 || *quality > 100) throw usage_error("--quality takes a number from 1 to 100.");
    web.quality = *quality;
  }
  web.zooms = zoom ? parse_zooms(*zoom) : exports::usual_zooms(store, request(store.crs_wkt()).area);
  return web;
}

exports::MapRequest ExportOptions::web_request(const tiles::TileStore& store,
                                               const exports::WebTileOptions& web) const {
  exports::MapRequest on_zoom = request(store.crs_wkt());
  on_zoom.crs_wkt = exports::web_crs();
  on_zoom.cell = exports::web_cell(web.zooms.max);
  return on_zoom;
}

exports::TileScheme ExportOptions::tile_scheme() const {
  return scheme ? static_cast<exports::TileScheme>(index_of_word(*scheme, kSchemes, "--scheme"))
                : exports::TileScheme::xyz;
}

}  // namespace skysweep::app
