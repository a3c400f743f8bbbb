// SPDX-License-Identifier: Apache-2.0
// Which tiles the photographs touch, and which photographs a tile is made from.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "index/image_record.h"
#include "index/view_index.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

// Photographs come and go one by one, at a cost that hardly depends on how many there are. Reading is safe for several
// threads at once while nobody adds or removes.
class Coverage {
 public:
  explicit Coverage(const ProjectSettings& settings) : settings_(settings) {}
  Coverage(const std::vector<index::ImageRecord>& records, const ProjectSettings& settings);

  // Only photographs with status `used` count; others are ignored. `record` must outlive its stay; its name is new.
  void add(const index::ImageRecord& record);
  void remove(const std::string& name);

  // Level-0 tiles that this photograph may show: those that change when it comes or goes.
  std::vector<tiles::TileKey> touched(const index::ImageRecord& record) const;

  // Level-0 tiles that at least min_views photographs may show, and that meet `area` if one is given, along a
  // space-filling curve, so that neighbours share decoded photographs.
  std::vector<tiles::TileKey> tiles(const std::optional<Box2d>& area) const;

  // Whether enough photographs may show a tile.
  bool is_mapped(tiles::TileKey key) const;

  // The photographs that may show the tile or its collar, sorted by name. Decided in the tile's own frame.
  std::vector<const index::ImageRecord*> candidates(tiles::TileKey key) const;

  // Digest of the tile's place, these settings (settings_digest) and all its candidates. Asks nothing of the records:
  // when it is as it was, so is the tile.
  std::string candidates_digest(tiles::TileKey key, const std::string& settings) const;

 private:
  const ProjectSettings& settings_;
  index::ViewIndex index_;
  struct Entry {
    const index::ImageRecord* record = nullptr;  // null: removed
    Box2d ground;                                // of its view pyramid, in the world
    std::array<char, 32> digest{};
  };
  std::vector<int> candidate_ids(tiles::TileKey key) const;
  bool may_show(const Entry& entry, tiles::TileKey key, const Box2d& tile) const;
  std::vector<Entry> by_id_;
  std::unordered_map<std::string, int> ids_;
};

// Orders tiles along the curve.
void sort_along_curve(std::vector<tiles::TileKey>& keys);

// Footprint on the typical ground, for the catalogue.
std::vector<Vec2d> ground_footprint(const index::ImageRecord& image, const SearchRange& search);

}  // namespace skysweep::pipeline
