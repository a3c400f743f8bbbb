// SPDX-License-Identifier: Apache-2.0
// Digests of what tiles are computed from: equal digests, equal bytes.
#pragma once

#include <string>
#include <vector>

#include "index/image_record.h"
#include "pipeline/project.h"
#include "pipeline/tile_geometry.h"
#include "tiles/tile_key.h"

namespace skysweep::pipeline {

// Of everything in project.toml that tiles depend on: format version, backend, CRS, lattice, search, configuration.
std::string settings_digest(const ProjectSettings& settings);

// Of one photograph, as "<bytes>-<camera and pose>": says which of them changed.
std::string view_digest(const index::ImageRecord& image);

// Of one photograph: its name, bytes, camera and pose.
std::string photograph_digest(const index::ImageRecord& image);

// The photographs that a tile is swept with, in both steps, and all that the rest of them decides. Photographs that may
// show the tile but serve neither step have no part in it: they come and go without the tile being computed again.
struct TileInputs {
  index::ViewSelection guess;                 // for the coarse sweep over everything searched
  std::optional<sweep::HeightRange> heights;  // that it found
  index::ViewSelection chosen;                // for the fine sweep near those

  TileInputs() = default;
  // The inputs of a tile whose coarse sweep found these heights.
  TileInputs(const TileGeometry& geometry, const std::optional<sweep::HeightRange>& found);

  // `candidates` as the geometry was made from.
  std::string digest(tiles::TileKey key, const TileGeometry& geometry,
                     const std::vector<const index::ImageRecord*>& candidates, const std::string& settings) const;
};

}  // namespace skysweep::pipeline
