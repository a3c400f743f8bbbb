// SPDX-License-Identifier: Apache-2.0
#include "export/tile_sets.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "export/labels_file.h"
#include "export/sqlite_file.h"
#include "raster/crs.h"

namespace skysweep::exports {

namespace {

int from_south(int zoom, int y) { return (1 << zoom) - 1 - y; }

Error cannot_write(const Destination& to) {
  return failure("cannot write " + to.path().string() + ": the disk is full or not writable");
}

class FolderSink final : public TileSink {
 public:
  FolderSink(const Destination& to, TileScheme scheme, std::string extension)
      : to_(to), scheme_(scheme), extension_(std::move(extension)) {}

  void put(int zoom, int x, int y, const std::string& bytes) override {
    const std::filesystem::path folder = to_.result() / std::to_string(zoom) / std::to_string(x);
    const int row = scheme_ == TileScheme::tms ? from_south(zoom, y) : y;
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    std::ofstream out(folder / (std::to_string(row) + "." + extension_), std::ios::binary);
    out << bytes;
    out.close();
    if (!out) throw cannot_write(to_);
  }

 private:
  const Destination& to_;
  TileScheme scheme_;
  std::string extension_;
};

class MbtilesSink final : public TileSink {
 public:
  explicit MbtilesSink(SqliteFile& file)
      : insert_(file.prepare("INSERT INTO tiles(zoom_level, tile_column, tile_row, tile_data) VALUES (?, ?, ?, ?)")) {}

  void put(int zoom, int x, int y, const std::string& bytes) override {
    insert_.bind(1, zoom).bind(2, x).bind(3, from_south(zoom, y)).bind_blob(4, bytes).run();
  }

 private:
  SqliteStatement insert_;
};

struct LonLatBox {
  double west = 0, south = 0, east = 0, north = 0;
};

LonLatBox bounds_of(const MapRaster& map) {
  const auto at = [&](std::int64_t n) { return static_cast<double>(n) * map.cell; };
  const Box2d box{{at(map.cells.west), at(map.cells.south)}, {at(map.cells.east), at(map.cells.north)}};
  const Box2d degrees =
      raster::transformed_extent(map.crs_wkt, raster::output_crs_from_user_input("EPSG:4326", web_crs()), box);
  return {degrees.min.x, degrees.min.y, degrees.max.x, degrees.max.y};
}

std::string encoding_words(const WebTileOptions& options) {
  switch (options.encoding) {
    case TileEncoding::terrarium: return "Terrarium: height = R 256 + G + B / 256 - 32768 m, no height: alpha 0";
    case TileEncoding::terrain_rgb:
      return "Terrain-RGB: height = (R 65536 + G 256 + B) / 10 - 10000 m, no height: alpha 0";
    case TileEncoding::jpeg: return "JPEG, quality " + std::to_string(options.quality) + ", nothing known: white";
    case TileEncoding::webp:
      return options.quality == 100 ? "WebP, lossless" : "WebP, quality " + std::to_string(options.quality);
    case TileEncoding::float32: return "GeoTIFF of 32-bit floats, no-data NaN";
    case TileEncoding::png: return "PNG";
  }
  return {};
}

std::string no_data_words(TileEncoding encoding) {
  if (encoding == TileEncoding::float32) return "NaN";
  return encoding == TileEncoding::jpeg ? "none: white" : "alpha 0";
}

// What map libraries call the packing of heights.
std::string packing_name(TileEncoding encoding) {
  return encoding == TileEncoding::terrarium ? "terrarium" : encoding == TileEncoding::terrain_rgb ? "mapbox" : "";
}

void write_tilejson(const MapRaster& map, const WebTileOptions& options, TileScheme scheme,
                    const std::filesystem::path& path) {
  const LonLatBox b = bounds_of(map);
  nlohmann::json j = {{"tilejson", "3.0.0"},
                      {"name", map.labels.content},
                      {"tiles", {"{z}/{x}/{y}." + extension_of(options.encoding)}},
                      {"scheme", scheme == TileScheme::tms ? "tms" : "xyz"},
                      {"minzoom", options.zooms.min},
                      {"maxzoom", options.zooms.max},
                      {"bounds", {b.west, b.south, b.east, b.north}},
                      {"center", {(b.west + b.east) / 2, (b.south + b.north) / 2, options.zooms.max}}};
  if (const std::string packing = packing_name(options.encoding); !packing.empty()) j["encoding"] = packing;
  std::ofstream out(path);
  out << j.dump(1) << "\n";
}

void write_metadata(const MapRaster& map, const WebTileOptions& options, SqliteFile& file) {
  const LonLatBox b = bounds_of(map);
  const nlohmann::json bounds = {b.west, b.south, b.east, b.north};
  const nlohmann::json center = {(b.west + b.east) / 2, (b.south + b.north) / 2, options.zooms.max};
  const auto bare = [](const nlohmann::json& list) {
    const std::string text = list.dump();
    return text.substr(1, text.size() - 2);
  };
  std::map<std::string, std::string> words = label_words(map);
  words["NO_DATA"] = no_data_words(options.encoding);
  words["ENCODING"] = encoding_words(options);
  words["name"] = map.labels.content;
  words["description"] = map.labels.content;
  words["format"] = extension_of(options.encoding);
  words["bounds"] = bare(bounds);
  words["center"] = bare(center);
  words["minzoom"] = std::to_string(options.zooms.min);
  words["maxzoom"] = std::to_string(options.zooms.max);
  words["type"] = "baselayer";
  words["version"] = "1.0.0";
  if (const std::string packing = packing_name(options.encoding); !packing.empty()) words["encoding"] = packing;
  SqliteStatement insert = file.prepare("INSERT INTO metadata(name, value) VALUES (?, ?)");
  for (const auto& [name, value] : words) insert.bind_text(1, name).bind_text(2, value).run();
}

}  // namespace

WebTileSummary write_tile_folder(const MapRaster& map, const WebTileOptions& options, TileScheme scheme,
                                 const Destination& to, const raster::OnProgress& progress) {
  FolderSink sink(to, scheme, extension_of(options.encoding));
  const WebTileSummary summary = write_web_tiles(map, options, sink, progress);
  write_tilejson(map, options, scheme, to.result() / "tilejson.json");
  write_labels_json(map,
                    {{"ENCODING", encoding_words(options)},
                     {"NO_DATA", no_data_words(options.encoding)},
                     {"TILES", std::to_string(summary.tiles)}},
                    to.result() / kLabelsFile);
  return summary;
}

WebTileSummary write_mbtiles(const MapRaster& map, const WebTileOptions& options, const Destination& to,
                             const raster::OnProgress& progress) {
  if (options.encoding == TileEncoding::float32)
    throw usage_error(
        "MBTiles holds pictures only: choose --encoding terrarium or terrain-rgb, or --format web-tiles.");
  SqliteFile file(to.result(), to.path());
  file.run("BEGIN");
  file.run("CREATE TABLE metadata (name text, value text)");
  file.run("CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob)");
  file.run("CREATE UNIQUE INDEX tile_index on tiles (zoom_level, tile_column, tile_row)");
  WebTileSummary summary;
  {
    MbtilesSink sink(file);
    summary = write_web_tiles(map, options, sink, progress);
  }
  write_metadata(map, options, file);
  file.run("COMMIT");
  file.close();
  return summary;
}

}  // namespace skysweep::exports
