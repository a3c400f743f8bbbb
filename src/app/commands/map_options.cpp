// SPDX-License-Identifier: Apache-2.0
#include "app/commands/map_options.h"

#include <algorithm>
#include <thread>

#include "app/option_values.h"
#include "core/error.h"

namespace skysweep::app {

void add_map_options(CLI::App& command, MapOptions& options) {
  command.add_option("--crs", options.crs, "CRS of the map, e.g. EPSG:32632; none: a local metric frame");
  command.add_option("--origin", options.origin, "X,Y,Z added to the poses' positions to reach the CRS");
  command.add_option("--cell", options.cell, "Side of an output cell in metres (default: the photographs' median GSD)");
  command.add_option("--dz", options.dz, "Distance of height planes in metres (default: from the geometry)");
  command.add_option("--aoi", options.area, "x0,y0,x1,y1: only tiles that meet this rectangle, mosaics cropped to it");
  command.add_option("--z-range", options.heights, "LOW,HIGH: search these heights only (default: found by itself)");
  command.add_option("--preset", options.preset, "fast, balanced (default) or accurate");
  command.add_option("--config", options.config, "TOML file over the preset");
  command.add_option("--backend", options.backend,
                     "auto (default: gpu if the machine has a real one, else cpu), cpu, gpu or reference");
  command.add_option("--memory", options.memory, "Most memory to use, e.g. 4GiB (default: half of the machine's)");
  command.add_option("--threads", options.threads, "Number of threads (default: all)");
  command.add_flag(
      "--no-fill", options.no_fill,
      "Leave cells empty that the surface hides from the photographs (default: filled from the lower side)");
  command.add_flag("--planar-fallback", options.planar_fallback,
                   "Colour cells without height from a horizontal plane, marked as such in the mask");
}

void apply(const MapOptions& options, pipeline::RunRequest& request) {
  request.crs = options.crs;
  if (options.origin) request.origin = parse_origin(*options.origin);
  if (options.cell) request.cell_m = require_positive(*options.cell, "--cell");
  if (options.dz) request.dz_m = require_positive(*options.dz, "--dz");
  if (options.area) request.area = parse_area(*options.area);
  if (options.heights) request.heights = parse_height_range(*options.heights);
  request.preset = options.preset;
  if (options.config) request.config = *options.config;
  if (options.backend) request.backend = parse_backend(*options.backend);
  if (options.memory) request.memory_bytes = parse_memory(*options.memory);
  if (options.threads < 0) throw usage_error("--threads must be a positive number.");
  request.threads =
      options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  request.no_fill = options.no_fill;
  request.planar_fallback = options.planar_fallback;
}

}  // namespace skysweep::app
