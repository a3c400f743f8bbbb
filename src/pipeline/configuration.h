// SPDX-License-Identifier: Apache-2.0
// The settings of a run as presets and configuration files spell them: one typed struct per algorithm, and its TOML.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "index/view_selection.h"
#include "settings/toml_table.h"
#include "settings/toml_writer.h"
#include "sweep/sweep_options.h"

namespace skysweep::pipeline {

struct PhotographOptions {
  // Photographs that look further than this from nadir are kept in the catalogue but not matched.
  double near_vertical_limit_deg = 30;
};

struct TileOptions {
  int cells = 512;        // along a side of a tile; a multiple of 64
  int collar_cells = 32;  // swept around a tile and thrown away, so that what stands next door can hide its cells
};

struct Configuration {
  PhotographOptions photographs;
  TileOptions tiles;
  index::ViewSelectionOptions views;
  sweep::SweepOptions sweep;
};

// Reads the sections [photographs] [tiles] [views] [sweep]; keys that are absent keep their defaults. Throws
// Error(usage), naming file, line and key, for values that make no sense. Marks keys as known; the caller refuses the
// others.
Configuration configuration_from(const settings::TomlTable& toml);

// A preset with the user's file over it, unknown keys refused.
Configuration read_configuration(const std::string& preset, const std::optional<std::filesystem::path>& file);

// Every setting with its effective value, in a fixed order.
void write_configuration(settings::TomlWriter& toml, const Configuration& configuration);
std::string configuration_text(const Configuration& configuration);

}  // namespace skysweep::pipeline
