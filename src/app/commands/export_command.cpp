// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/export/options.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "core/error.h"
#include "export/exr_map.h"
#include "pipeline/project.h"
#include "raster/crs.h"

namespace skysweep::app {
namespace {

using exports::Destination;
using exports::DestinationKind;

// A share of the whole as steps of a progress line; stops when Ctrl-C asks.
class PercentSteps {
 public:
  PercentSteps(Console& console, const std::string& stage) : console_(console) { console.begin(stage, 100); }
  raster::OnProgress callback() {
    return [this](double share) {
      for (; done_ < static_cast<int>(100 * share + 1e-6); ++done_) console_.advance();
      return !interrupt_requested();
    };
  }

 private:
  Console& console_;
  int done_ = 0;
};

std::string size_text(const exports::MapRaster& map) {
  char text[120];
  std::snprintf(text, sizeof text, "%lld x %lld cells of %.9g", static_cast<long long>(map.cells.width()),
                static_cast<long long>(map.cells.height()), map.cell);
  return text;
}

void say_map(const Destination& to, const exports::MapRaster& map, const std::string& what, Console& console) {
  console.say(to.path().string() + ": " + map.labels.content + ", " + what + ". CRS: " + raster::crs_name(map.crs_wkt) +
              "." + (map.labels.vertical_reference.empty() ? "" : " Heights: " + map.labels.vertical_reference + "."));
}

// The layer on its lattice; shading, where there is some, has a progress line of its own.
exports::MapRaster layer_of(const exports::MapRequest& request, const tiles::TileStore& store, const Destination& to,
                            Console& console) {
  if (request.layer != exports::Layer::hillshade && request.layer != exports::Layer::relief)
    return exports::map_raster(store, request, to.scratch());
  PercentSteps steps(console, "shading");
  return exports::map_raster(store, request, to.scratch(), steps.callback());
}

// Formats of one layer on a free lattice.
void write_raster(const ExportOptions& options, const tiles::TileStore& store, const Destination& to,
                  Console& console) {
  const exports::MapRaster map = layer_of(options.request(store.crs_wkt()), store, to, console);
  PercentSteps steps(console, "export");
  std::string what = size_text(map);
  switch (options.chosen_format()) {
    case ExportFormat::geotiff_tiles:
      what += " in " + std::to_string(exports::write_geotiff_tiles(map, options.tile_size(), to, steps.callback())) +
              " tiles";
      break;
    case ExportFormat::ascii_grid: exports::write_ascii_grid(map, to, steps.callback()); break;
    case ExportFormat::xyz_text:
      what += ", " + std::to_string(exports::write_xyz_text(map, to, steps.callback())) + " points";
      break;
    default: exports::write_cog(map, to, steps.callback());
  }
  say_map(to, map, what, console);
}

void write_web(const ExportOptions& options, const tiles::TileStore& store, const Destination& to, Console& console) {
  const exports::WebTileOptions web = options.web_tiles(store);
  const exports::MapRaster map = layer_of(options.web_request(store, web), store, to, console);
  PercentSteps steps(console, "export");
  const exports::WebTileSummary summary =
      options.chosen_format() == ExportFormat::mbtiles
          ? exports::write_mbtiles(map, web, to, steps.callback())
          : exports::write_tile_folder(map, web, options.tile_scheme(), to, steps.callback());
  if (summary.lost_no_data)
    console.warn("JPEG has no transparency: where nothing is known the tiles are white. --encoding webp keeps it.");
  say_map(to, map,
          std::to_string(summary.tiles) + " tiles of zoom " + std::to_string(web.zooms.min) + " to " +
              std::to_string(web.zooms.max),
          console);
}

void write_exr(const ExportOptions& options, const tiles::TileStore& store, const Destination& to, Console& console) {
  const exports::MapParts parts = exports::map_parts(store, options.request(store.crs_wkt()), to.scratch());
  PercentSteps steps(console, "export");
  exports::write_exr_map(parts, to, steps.callback());
  say_map(to, parts.height, "sigma, colour and mask, " + size_text(parts.height), console);
}

void write_format(const ExportOptions& options, const tiles::TileStore& store, const Destination& to,
                  Console& console) {
  switch (options.chosen_format()) {
    case ExportFormat::web_tiles:
    case ExportFormat::mbtiles: return write_web(options, store, to, console);
    case ExportFormat::exr: return write_exr(options, store, to, console);
    default: return write_raster(options, store, to, console);
  }
}

// Wrong words are named before anything is made on the disk.
void check_words(const ExportOptions& options, const tiles::TileStore& store) {
  options.check();
  options.request(store.crs_wkt());
  options.tile_size();
  options.tile_scheme();
  const ExportFormat format = options.chosen_format();
  if (format == ExportFormat::web_tiles || format == ExportFormat::mbtiles) options.web_tiles(store);
}

DestinationKind kind_of(ExportFormat format) {
  return format == ExportFormat::geotiff_tiles || format == ExportFormat::web_tiles ? DestinationKind::folder
                                                                                    : DestinationKind::file;
}

int export_map(const ExportOptions& options) {
  options.chosen_format();
  const pipeline::ProjectPaths paths(options.project);
  if (!pipeline::project_exists(paths))
    throw bad_input(options.project + " holds no project (project.toml is missing).");
  Console console(options.json_log);
  const pipeline::ProjectSettings settings = pipeline::read_project(paths);
  const tiles::TileStore store = pipeline::open_store(paths, settings);
  check_words(options, store);
  Destination to(options.output, kind_of(options.chosen_format()), options.overwrite);
  interrupt_requested();  // from here on Ctrl-C cleans up
  try {
    write_format(options, store, to, console);
    to.publish();
  } catch (const raster::Stopped&) {
    console.say("Interrupted. Nothing was written.");
    return kExitInterrupted;
  }
  return 0;
}

}  // namespace

void add_export_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command =
      program.add_subcommand("export", "Write the map, or a part of it, in a format for GIS or web maps.");
  auto o = std::make_shared<ExportOptions>();
  command->add_option("PROJECT", o->project, "Project folder")->required();
  command->add_option("-o,--output", o->output, "File or folder to make")->required();
  command->add_option("--format", o->format, "cog, geotiff-tiles, web-tiles, mbtiles, ascii-grid, xyz-text or exr")
      ->required();
  command->add_option("--layer", o->layer, "dsm (default), ortho, confidence, mask, hillshade or relief");
  command->add_option("--aoi", o->area, "Only x0,y0,x1,y1, in the map's CRS");
  command->add_option("--crs", o->crs, "CRS of the output, e.g. EPSG:4326; heights are not converted");
  command->add_option("--cell,--resolution", o->cell, "Side of a cell in units of the output's CRS");
  command->add_option("--resampling", o->resampling, "nearest, bilinear (default), cubic or average");
  command->add_option("--relief-range", o->relief_range, "LOW,HIGH: heights at the ends of the relief's colours");
  command->add_option("--tile-cells", o->tile_cells, "Side of a GeoTIFF tile in cells (default 1024)");
  command->add_option("--overlap", o->overlap, "Cells that a GeoTIFF tile shows of its neighbours (default 0)");
  command->add_option("--zoom", o->zoom, "Zooms of web tiles, A-B (default: from one tile to the map's cells)");
  command->add_option("--encoding", o->encoding,
                      "Web tiles: png, webp or jpeg for pictures, terrarium, terrain-rgb or float32 for heights");
  command->add_option("--quality", o->quality, "Of webp and jpeg tiles, 1 to 100 (default 85; webp 100 is lossless)");
  command->add_option("--scheme", o->scheme, "Rows of web tiles from the north, xyz (default), or the south, tms");
  command->add_flag("--overwrite", o->overwrite, "Replace what an earlier export has left there");
  command->add_flag("--json-log", o->json_log, "One JSON object a line instead of text");
  command->callback([o, &chosen] { chosen = [o] { return export_map(*o); }; });
}

}  // namespace skysweep::app
