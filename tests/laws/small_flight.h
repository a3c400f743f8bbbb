// SPDX-License-Identifier: Apache-2.0
// What the laws are tried on: a small simulated flight over a few buildings, mapped in tiles so small that there are
// more than a dozen, and ways to run it and to look at what came out.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <string>

#include "core/executor.h"
#include "pipeline/session.h"
#include "raster/temp_folder.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace skysweep::laws {

using testing_support::file_bytes;
using testing_support::put_bytes;
using testing_support::TempFolder;

inline constexpr const char* kScene = R"(
seed = 5
area_m = [15, 12]

[terrain]
relief_m = 0.6
wavelength_m = 15

[[building]]
center = [5, 5]
size_m = [4, 3]
heading_deg = 20
roof_z_m = 2

[[building]]
center = [11, 8]
size_m = [2.5, 2.5]
roof_z_m = 1.2

[camera]
width_px = 320
height_px = 240
focal_px = 310

[flight]
gsd_m = 0.05
along_overlap = 0.75
across_overlap = 0.65
beyond_area_m = -3
tilt_sigma_deg = 1.0
position_sigma_m = 0.1
)";

inline constexpr int kTileCells = 64;
inline constexpr double kCellM = 0.1;  // not exact in binary, like most cell sizes people ask for

// Ignores everything.
inline pipeline::Progress& silence() {
  static pipeline::Progress progress;
  return progress;
}

class SmallFlight : public testing::Test {
 protected:
  SmallFlight() {
    SerialExecutor executor;
    scene::simulate(scene::parse_scene(kScene, "small flight"), folder / "flight", executor);
    write_tile_settings("");
  }

  // The settings of every run of this test: small tiles, and what a law needs besides.
  void write_tile_settings(const std::string& more) {
    put_bytes(folder / "laws.toml", "[tiles]\ncells = " + std::to_string(kTileCells) + "\ncollar_cells = 16\n" + more);
  }

  pipeline::RunRequest request(const std::string& project) const {
    pipeline::RunRequest r;
    r.images = folder / "flight" / "images";
    r.poses = folder / "flight" / "poses.csv";
    r.project = folder / project;
    r.cell_m = kCellM;
    r.config = folder / "laws.toml";
    return r;
  }

  static pipeline::RunSummary run(const pipeline::RunRequest& request, pipeline::Progress& progress = silence()) {
    static const std::atomic<bool> never{false};
    return pipeline::run(request, progress, never);
  }

  tiles::TileStore store(const pipeline::RunRequest& request) const {
    const pipeline::ProjectPaths paths(request.project);
    return pipeline::open_store(paths, pipeline::read_project(paths));
  }

  TempFolder folder;
};

// Every file below a project's tiles/ folder by its place there: all layers of all levels.
using TileFiles = std::map<std::string, std::string>;

inline TileFiles tile_files(const pipeline::RunRequest& request) {
  const std::filesystem::path root = pipeline::ProjectPaths(request.project).tiles();
  TileFiles files;
  if (!std::filesystem::exists(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(root).string()] = file_bytes(entry.path());
  return files;
}

// The same files with the same bytes; says which differ instead of printing them.
inline void expect_same_files(const TileFiles& expected, const TileFiles& actual) {
  ASSERT_FALSE(expected.empty());
  for (const auto& [name, bytes] : expected) {
    const auto found = actual.find(name);
    if (found == actual.end())
      ADD_FAILURE() << name << " is missing";
    else
      EXPECT_TRUE(found->second == bytes) << name << " has other bytes";
  }
  for (const auto& [name, bytes] : actual) EXPECT_TRUE(expected.contains(name)) << name << " should not be there";
}

}  // namespace skysweep::laws
