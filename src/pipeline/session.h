// SPDX-License-Identifier: Apache-2.0
// A run over a folder of photographs: from files to a project whose tiles and catalogue are complete.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "formats/pose_set.h"
#include "index/image_record.h"
#include "pipeline/memory_plan.h"
#include "pipeline/progress.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

// Photographs that somebody has already found and paired with their poses.
struct GivenPhotographs {
  std::vector<std::string> names;  // relative to RunRequest::images, as raster::list_photos has them
  formats::PoseSet poses;
};

struct RunRequest {
  std::filesystem::path images;
  std::filesystem::path poses;
  std::optional<GivenPhotographs> given;  // instead of all that `images` holds and of what `poses` says
  std::filesystem::path project;
  std::optional<std::string> crs;  // as the user names it; none: a local metric frame
  Vec3d origin;                    // added to the poses' positions
  std::optional<double> cell_m;
  std::optional<double> dz_m;
  std::optional<Box2d> area;  // --aoi, map coordinates
  std::optional<sweep::HeightRange> heights;
  std::optional<std::string> preset;
  std::optional<std::filesystem::path> config;
  std::optional<sweep::Backend> backend;
  std::optional<std::size_t> memory_bytes;
  int threads = 1;
  bool no_fill = false;                      // as [sweep] fill = false
  bool planar_fallback = false;              // as [sweep] planar_fallback = true
  bool fresh = false;                        // throw away what the project holds
  bool dry_run = false;                      // find out everything, write nothing
  bool verify = false;                       // read every photograph and every tile, not only sizes and times
  std::vector<std::string> remove, restore;  // patterns of photographs to take out of the project, or back
};

struct RunSummary {
  ProjectSettings settings;
  std::vector<index::ImageRecord> images;
  MemoryPlan memory;
  std::uint64_t disk_bytes_needed = 0;  // at most
  int tiles_planned = 0;
  int tiles_computed = 0;
  int tiles_kept = 0;     // already there with the same inputs
  int tiles_stale = 0;    // of a dry run: those that a run would compute
  int tiles_removed = 0;  // touched by too few photographs now
  // Cells of the tiles computed: measured, and filled from their surroundings.
  std::uint64_t cells_measured = 0, cells_filled = 0;
  int tiles_empty = 0;  // looked at, and nothing could be known
  int parents_written = 0;
  int quadrants_made = 0;  // of the parents written
  std::string map_digest;  // of all level-0 tiles: what products are made from
  double samples = 0;      // luminance samples of the fine sweep
  int photographs_decoded = 0;
  bool interrupted = false;
};

// Throws Error. When `stop` becomes true, tiles in work are finished, nothing new is begun, parents are brought up to
// date, and the summary says interrupted: the next run goes on from there.
RunSummary run(const RunRequest& request, Progress& progress, const std::atomic<bool>& stop);

}  // namespace skysweep::pipeline
