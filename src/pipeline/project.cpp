// SPDX-License-Identifier: Apache-2.0
#include "pipeline/project.h"

#include "core/error.h"
#include "raster/atomic_file.h"
#include "raster/crs.h"

namespace skysweep::pipeline {
namespace {

using settings::TomlTable;
using settings::TomlWriter;

TomlTable section(const TomlTable& toml, const char* name) {
  const auto table = toml.table(name);
  if (!table) throw bad_input(toml.where(name) + " is missing: this is no project.toml of Skysweep.");
  return *table;
}

template <typename T>
T required(const TomlTable& table, const char* key, const std::optional<T>& value) {
  if (!value) throw bad_input(table.where(key) + " is missing.");
  return *value;
}

double required_positive(const TomlTable& table, const char* key) {
  const double value = required(table, key, table.number(key));
  if (!(value > 0)) throw bad_input(table.where(key) + " must be positive.");
  return value;
}

sweep::Backend backend_named(const std::string& name, const TomlTable& table) {
  for (const sweep::Backend backend : {sweep::Backend::reference, sweep::Backend::cpu, sweep::Backend::gpu})
    if (name == sweep::to_string(backend)) return backend;
  throw bad_input(table.where("backend") + " is unknown.");
}

SearchRange read_search(const TomlTable& table) {
  SearchRange search;
  search.ground_depth_m = required_positive(table, "ground_depth_m");
  search.reach_depth_m = required_positive(table, "reach_depth_m");
  search.nearest_depth_m = required_positive(table, "nearest_depth_m");
  search.farthest_depth_m = required_positive(table, "farthest_depth_m");
  if (const auto heights = table.numbers("heights_m")) {
    if (heights->size() != 2) throw bad_input(table.where("heights_m") + " must be two heights.");
    search.heights = sweep::HeightRange{(*heights)[0], (*heights)[1]};
  }
  return search;
}

}  // namespace

bool project_exists(const ProjectPaths& paths) { return std::filesystem::exists(paths.settings()); }

ProjectSettings read_project(const ProjectPaths& paths) {
  const TomlTable toml = TomlTable::read_file(paths.settings());
  ProjectSettings settings;
  const TomlTable source = section(toml, "source");
  settings.images = required(source, "images", source.string("images"));
  const TomlTable program = section(toml, "program");
  const auto version = required(program, "format_version", program.integer("format_version"));
  if (version != kFormatVersion)
    throw bad_input(paths.settings().string() + " was made by another version of Skysweep (format " +
                    std::to_string(version) + ", this one writes " + std::to_string(kFormatVersion) +
                    "): run again with --fresh.");
  const std::string backend = required(program, "backend", program.string("backend"));
  program.string("software");
  settings.backend = backend_named(backend, program);
  settings.instruction_set = required(program, "instruction_set", program.string("instruction_set"));
  if (settings.backend == sweep::Backend::gpu)
    settings.gpu_device = required(program, "gpu_device", program.string("gpu_device"));

  const TomlTable map = section(toml, "map");
  settings.crs_wkt = required(map, "crs", map.string("crs"));
  map.string("crs_name");
  map.string("vertical_reference");

  const TomlTable lattice = section(toml, "lattice");
  settings.lattice.cell_m = required_positive(lattice, "cell_m");
  settings.lattice.dz_m = required_positive(lattice, "dz_m");
  settings.search = read_search(section(toml, "search"));
  settings.configuration = configuration_from(toml);
  settings.lattice.tile_cells = settings.configuration.tiles.cells;
  toml.refuse_unknown();
  return settings;
}

namespace {

// Without a name for the software it is left out.
void write_settings(TomlWriter& toml, const ProjectSettings& settings, const std::string& software) {
  toml.section("program");
  toml.integer("format_version", kFormatVersion);
  if (!software.empty()) toml.string("software", software);
  toml.string("backend", sweep::to_string(settings.backend));
  toml.string("instruction_set", settings.instruction_set);
  if (settings.backend == sweep::Backend::gpu) toml.string("gpu_device", settings.gpu_device);
  toml.section("map");
  toml.string("crs", settings.crs_wkt);
  toml.string("crs_name", raster::crs_name(settings.crs_wkt));
  toml.string("vertical_reference", raster::vertical_reference(settings.crs_wkt));
  toml.section("lattice");
  toml.number("cell_m", settings.lattice.cell_m);
  toml.number("dz_m", settings.lattice.dz_m);
  toml.section("search");
  toml.number("ground_depth_m", settings.search.ground_depth_m);
  toml.number("reach_depth_m", settings.search.reach_depth_m);
  toml.number("nearest_depth_m", settings.search.nearest_depth_m);
  toml.number("farthest_depth_m", settings.search.farthest_depth_m);
  if (settings.search.heights)
    toml.numbers("heights_m", {settings.search.heights->z_low, settings.search.heights->z_high});
  write_configuration(toml, settings.configuration);
}

}  // namespace

std::string settings_text(const ProjectSettings& settings) {
  TomlWriter toml;
  write_settings(toml, settings, "");
  return toml.text();
}

void write_project(const ProjectPaths& paths, const ProjectSettings& settings) {
  TomlWriter toml;
  toml.comment("Fixed when the project was made: tiles depend on every line but those of [source].");
  toml.section("source");
  toml.string("images", settings.images.string());
  write_settings(toml, settings, software_name());
  raster::write_bytes_atomically(paths.settings(), toml.text());
}

std::string software_name() { return std::string("skysweep ") + SKYSWEEP_VERSION; }

tiles::TileStore open_store(const ProjectPaths& paths, const ProjectSettings& settings) {
  return {paths.tiles(), settings.lattice, settings.crs_wkt, raster::vertical_reference(settings.crs_wkt),
          software_name()};
}

}  // namespace skysweep::pipeline
