// SPDX-License-Identifier: Apache-2.0
// A tile's own frame: origin at its south-west corner, so that no coordinate is large and moving the whole scene by
// whole tiles changes no bit. Everything a tile is computed from passes through here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "index/image_record.h"
#include "index/view_selection.h"
#include "pipeline/project.h"
#include "sweep/sweep_problem.h"

namespace skysweep::pipeline {

class TileGeometry {
 public:
  TileGeometry(tiles::TileKey key, const std::vector<const index::ImageRecord*>& candidates,
               const ProjectSettings& settings);

  // Grid of the tile with its collar; no views, no planes.
  sweep::SweepProblem empty_problem() const;

  // The ground as the project's typical depth puts it below these cameras; and everything a surface may be at.
  sweep::HeightRange guessed_heights() const;
  sweep::HeightRange searched_heights() const;
  // Whether anything but the choice of views depends on the guess: exposures are compared on it.
  bool guess_is_compared_on() const;

  index::ViewSelection select(const sweep::HeightRange& heights) const;
  std::vector<std::string> names(const index::ViewSelection& selection) const;
  std::vector<sweep::View> views(const index::ViewSelection& selection,
                                 const std::vector<std::shared_ptr<const sweep::ImagePyramid>>& images,
                                 const sweep::HeightRange& heights) const;
  // The mipmap levels that these views are sampled at.
  std::vector<int> base_levels(const index::ViewSelection& selection, const sweep::HeightRange& heights) const;

 private:
  int base_level(const camera::Camera& camera, const sweep::HeightRange& heights) const;

  const ProjectSettings& settings_;
  std::vector<index::ViewCandidate> candidates_;  // in the tile's frame
};

// Ground rectangle of a tile with its collar, in the world: what candidates are looked up with.
Box2d tile_with_collar(tiles::TileKey key, const ProjectSettings& settings);

}  // namespace skysweep::pipeline
