// SPDX-License-Identifier: Apache-2.0
// Which tiles the photographs touch, and which photographs a tile is made from.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "index/image_record.h"
#include "index/view_index.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

class Coverage {
 public:
  // `records` sorted by name; both must outlive this object. Only photographs with status `used` count.
  Coverage(const std::vector<index::ImageRecord>& records, const ProjectSettings& settings);

  // Level-0 tiles that at least min_views photographs may show, and that meet `area` if one is given, along a
  // space-filling curve, so that neighbours share decoded photographs.
  std::vector<tiles::TileKey> tiles(const std::optional<Box2d>& area) const;

  // The photographs that may show the tile or its collar, sorted by name. Decided in the tile's own frame.
  std::vector<const index::ImageRecord*> candidates(tiles::TileKey key) const;

 private:
  // Tiles within `mapped` that the box of any photograph comes near; a tile that none does has no candidates.
  std::set<tiles::TileKey> touched_tiles(const Box2d& mapped) const;

  const std::vector<index::ImageRecord>& records_;
  const ProjectSettings& settings_;
  index::ViewIndex index_;
};

// Footprint on the typical ground, for the catalogue.
std::vector<Vec2d> ground_footprint(const index::ImageRecord& image, const SearchRange& search);

}  // namespace skysweep::pipeline
