// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recover_catalogue.h"

#include "core/error.h"

namespace skysweep::pipeline {
namespace {

namespace fs = std::filesystem;

OpenCatalogue read_all(const ProjectPaths& paths, const std::string& crs_wkt) {
  OpenCatalogue catalogue;
  catalogue.file = std::make_unique<index::Catalogue>(paths.catalogue(), crs_wkt);
  catalogue.tiles = std::make_unique<MapRecords>(*catalogue.file);
  catalogue.images = catalogue.file->images();
  return catalogue;
}

void move_away(const fs::path& file, const fs::path& to) {
  std::error_code error;
  fs::rename(file, to, error);
  if (error) throw failure("cannot move the damaged catalogue " + file.string() + " away: " + error.message());
  for (const char* ending : {"-journal", "-wal", "-shm"}) fs::remove(file.string() + ending, error);
}

}  // namespace

OpenCatalogue open_catalogue(const ProjectPaths& paths, const std::string& crs_wkt, Progress& progress) {
  try {
    return read_all(paths, crs_wkt);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input) throw;
    const fs::path kept = paths.folder / "catalog.damaged.gpkg";
    move_away(paths.catalogue(), kept);
    progress.warn("The catalogue was damaged (" + std::string(error.what()) + "). It is kept as " + kept.string() +
                  " and made again from the photographs and the tiles.");
  }
  return read_all(paths, crs_wkt);
}

}  // namespace skysweep::pipeline
