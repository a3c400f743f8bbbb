// SPDX-License-Identifier: Apache-2.0
// Options of every command that makes maps: `run` and `watch`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "pipeline/session.h"

namespace skysweep::app {

// As they stand on the command line.
struct MapOptions {
  std::optional<std::string> crs, origin, area, heights, preset, config, backend, memory;
  std::optional<double> cell, dz;
  int threads = 0;
  bool no_fill = false, planar_fallback = false;
};

// `options` must live until the command has been parsed.
void add_map_options(CLI::App& command, MapOptions& options);

// Throws Error(usage), naming the option.
void apply(const MapOptions& options, pipeline::RunRequest& request);

}  // namespace skysweep::app
