// SPDX-License-Identifier: Apache-2.0
// dsm.vrt and ortho.vrt of a project, kept up with its tiles.
#pragma once

#include <chrono>

#include "pipeline/map_records.h"
#include "pipeline/project.h"
#include "tiles/tile_store.h"

namespace skysweep::pipeline {

class LiveMosaics {
 public:
  LiveMosaics(const ProjectPaths& paths, const tiles::TileStore& store) : paths_(paths), store_(store) {}

  // As the records say; files that would not change are left alone, and go when the map has no tile.
  void write(const MapRecords& records);

  // Before tiles are removed, so that no mosaic ever names a file that is not there.
  void write_without(const MapRecords& records, const std::vector<tiles::TileKey>& leaving);

  // The same as `write`, but not more often than every other second: for tiles that come one by one.
  void write_now_and_then(const MapRecords& records);

 private:
  ProjectPaths paths_;
  const tiles::TileStore& store_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace skysweep::pipeline
