// SPDX-License-Identifier: Apache-2.0
// Whether a tile on disk is what a run would make of the photographs as they are now, and if not, why not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "index/catalogue.h"
#include "pipeline/coverage.h"
#include "pipeline/project.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

struct TileCheck {
  bool fresh = false;
  std::string why;       // a sentence without its tile: "DJI_7.jpg is new"
  bool damaged = false;  // its files are not as they were written
  // For a fresh tile: its row as the catalogue should hold it; it differs from the row given when photographs came or
  // went without serving the tile, files were copied, or the row was lost and told again by the tile's own labels.
  index::TileRecord row;
};

class TileChecker {
 public:
  // `read_everything`: checksums of all files are compared (--verify), not only their sizes and times.
  TileChecker(const ProjectSettings& settings, const tiles::TileStore& store, bool read_everything);

  // `row` null: the catalogue has none.
  TileCheck check(tiles::TileKey key, const Coverage& coverage, const index::TileRecord* row) const;

  // Whether the files are as the row says; the stamp of the row is renewed if they were merely touched.
  bool files_are_as_written(tiles::TileKey key, index::TileRecord& row) const;

  const std::string& settings() const { return settings_digest_; }

 private:
  std::optional<index::TileRecord> row_from_labels(tiles::TileKey key,
                                                   const std::vector<const index::ImageRecord*>& candidates) const;

  const ProjectSettings& settings_;
  const tiles::TileStore& store_;
  bool read_everything_;
  std::string settings_digest_;
};

// Fills what the catalogue keeps of the files of a tile: checksum and stamp, both empty if it has none.
void note_files(const tiles::TileStore& store, tiles::TileKey key, index::TileRecord& row);

}  // namespace skysweep::pipeline
