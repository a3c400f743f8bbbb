// SPDX-License-Identifier: Apache-2.0
// The catalogue of a project, whatever state it is found in.
#pragma once

#include <vector>

#include "index/catalogue.h"
#include "pipeline/map_records.h"
#include "pipeline/progress.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

// An open catalogue and what it held.
struct OpenCatalogue {
  std::unique_ptr<index::Catalogue> file;
  std::unique_ptr<MapRecords> tiles;
  std::vector<index::ImageRecord> images;
};

// Opens the catalogue, or makes it when it is missing. A damaged one is moved to catalog.damaged.gpkg, with a warning,
// and a new one made: photographs are listed again, and what tiles are made from their own labels tell.
OpenCatalogue open_catalogue(const ProjectPaths& paths, const std::string& crs_wkt, Progress& progress);

}  // namespace skysweep::pipeline
