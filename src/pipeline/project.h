// SPDX-License-Identifier: Apache-2.0
// A project folder and what was fixed when it was made: project.toml. Tiles are a pure function of this, the
// photographs and their poses.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/configuration.h"
#include "sweep/backend.h"
#include "sweep/height_range.h"
#include "tiles/lattice.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

// Changes when the same inputs would give other tiles.
inline constexpr int kFormatVersion = 2;

// Where surfaces are looked for below a camera.
struct SearchRange {
  double ground_depth_m = 0;   // vertical distance from the cameras to the ground, typically
  double reach_depth_m = 0;    // photographs count for the places they show down to this depth
  double nearest_depth_m = 0;  // no surface is looked for nearer to a camera than this
  double farthest_depth_m = 0;
  std::optional<sweep::HeightRange> heights;  // --z-range: absolute heights instead
};

struct ProjectSettings {
  std::filesystem::path images;  // where the photographs lie; tiles do not depend on it
  tiles::Lattice lattice;
  std::string crs_wkt;
  SearchRange search;
  Configuration configuration;
  sweep::Backend backend = sweep::Backend::cpu;
  std::string instruction_set;  // of the cpu backend; empty for the others
  std::string gpu_device;       // of the gpu backend, by its driver's name; empty for the others
};

struct ProjectPaths {
  explicit ProjectPaths(std::filesystem::path project) : folder(std::move(project)) {}
  std::filesystem::path folder;
  std::filesystem::path settings() const { return folder / "project.toml"; }
  std::filesystem::path catalogue() const { return folder / "catalog.gpkg"; }
  std::filesystem::path tiles() const { return folder / "tiles"; }
  std::filesystem::path removals() const { return folder / "removed.toml"; }
  std::filesystem::path vrt(const std::string& name) const { return folder / (name + ".vrt"); }
  std::filesystem::path log() const { return folder / "run.log"; }
  std::filesystem::path mosaic(const std::string& name) const { return folder / (name + ".tif"); }
};

bool project_exists(const ProjectPaths& paths);
ProjectSettings read_project(const ProjectPaths& paths);
void write_project(const ProjectPaths& paths, const ProjectSettings& settings);

// Everything tiles depend on, as TOML: what project.toml holds, less the place of the photographs and the software, of
// which only the format version counts: a new release does not throw a map away that it would make in the same way.
std::string settings_text(const ProjectSettings& settings);

// "skysweep 0.1.0": goes into every raster.
std::string software_name();

tiles::TileStore open_store(const ProjectPaths& paths, const ProjectSettings& settings);

}  // namespace skysweep::pipeline
