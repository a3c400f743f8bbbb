// SPDX-License-Identifier: Apache-2.0
// What a project knows of its tiles: the catalogue's rows, kept in memory beside the file, so that a question costs no
// disk. Not safe for several threads at once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "index/catalogue.h"
#include "tiles/pyramid.h"
#include "tiles/tile_key.h"

namespace skysweep::pipeline {

class MapRecords {
 public:
  // Reads all rows; a row whose name is no tile's is passed over.
  explicit MapRecords(index::Catalogue& catalogue);

  const index::TileRecord* find(tiles::TileKey key) const;  // null: none
  const std::map<tiles::TileKey, index::TileRecord>& rows() const { return rows_; }

  // Both go to the catalogue at once, each in one transaction.
  void put(const std::vector<index::TileRecord>& rows);
  void remove(const std::vector<tiles::TileKey>& keys);

  // Level-0 tiles that have files, with the digests they were made with.
  std::map<tiles::TileKey, std::string> finest() const;

  // Digest of the map: equal for maps of the same tiles.
  std::string digest() const;

 private:
  index::Catalogue& catalogue_;
  std::map<tiles::TileKey, index::TileRecord> rows_;
};

// A parent as a row, and back. `extent` in world coordinates, `level` of the top: the one above the highest regular.
index::TileRecord row_of_parent(tiles::TileKey key, int level, const Box2d& extent, const tiles::ParentState& state);
tiles::ParentState parent_of_row(const index::TileRecord& row);

}  // namespace skysweep::pipeline
