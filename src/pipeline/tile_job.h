// SPDX-License-Identifier: Apache-2.0
// One tile from its photographs: a pure function of the photographs that can see it, their poses and the project's
// settings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/executor.h"
#include "index/image_record.h"
#include "index/view_selection.h"
#include "pipeline/photo_cache.h"
#include "pipeline/project.h"
#include "sweep/plane_sweep.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

// A photograph that could not be decoded when a tile needed it.
class PhotographFailed : public std::exception {
 public:
  PhotographFailed(std::string name, std::string reason) : name_(std::move(name)), reason_(std::move(reason)) {}
  const std::string& name() const { return name_; }
  const char* what() const noexcept override { return reason_.c_str(); }

 private:
  std::string name_, reason_;
};

// What a tile is asked to be swept with: the problem, and the photographs it points to.
struct PreparedTile {
  std::string input_digest;  // of everything the result depends on (pipeline/tile_digest.h)
  index::ViewSelection selection;
  std::vector<std::string> view_names;  // of problem.views
  std::vector<std::shared_ptr<const sweep::ImagePyramid>> images;
  sweep::SweepProblem problem;    // of the tile and its collar; empty planes when nothing can be matched
  Array2d<float> coarse_surface;  // what the planes were chosen by (sweep/height_range.h); may be empty
  std::optional<sweep::HeightRange> heights;
};

// `candidates`: the used photographs whose view pyramids meet the tile, sorted by name.
PreparedTile prepare_tile(tiles::TileKey key, const std::vector<const index::ImageRecord*>& candidates,
                          const ProjectSettings& settings, PhotoCache& photos, Executor& executor);

struct TileOutcome {
  tiles::Tile tile;
  std::string input_digest;
  std::vector<std::string> views;
  std::optional<sweep::HeightRange> heights;  // found by the coarse sweep
  double valid_share = 0;                     // cells with a height
  std::uint64_t cells_measured = 0, cells_filled = 0;
  double samples = 0;  // luminance samples of the fine sweep
  bool empty() const;  // neither height nor colour anywhere
};

TileOutcome compute_tile(tiles::TileKey key, const std::vector<const index::ImageRecord*>& candidates,
                         const ProjectSettings& settings, PhotoCache& photos, Executor& executor);

}  // namespace skysweep::pipeline
