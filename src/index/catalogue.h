// SPDX-License-Identifier: Apache-2.0
// The project's catalogue on disk: a GeoPackage that QGIS and ogrinfo open. Layers: `images` (footprint polygon, pose,
// camera, status, reason), `cameras` (table), `tiles` (rectangle, digest, views, seconds).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/box.h"
#include "index/image_record.h"

namespace skysweep::index {

// A tile as the catalogue lists it; `name` as tiles::TileKey prints it.
struct TileRecord {
  std::string name;
  int level = 0;
  Box2d extent;
  std::string input_digest;
  std::vector<std::string> views;  // names of the photographs it was computed from
  double valid_share = 0;          // share of cells with a height
  double z_low = 0, z_high = 0;    // heights that were searched
  double seconds = 0;
};

// Changes go to disk in transactions: each function is one. Throws Error(failed) if the file cannot be written and
// Error(bad_input) if it is damaged. Not safe for several threads at once.
class Catalogue {
 public:
  // Opens the file, or makes it when it is missing, with this CRS (a local frame is one too).
  Catalogue(const std::filesystem::path& path, const std::string& crs_wkt);
  ~Catalogue();
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;

  // Adds records, or replaces those of the same name. All numbers come back bit for bit, except that the camera or pose
  // of a refused photograph is dropped if a number in it is not finite.
  void put_images(const std::vector<ImageRecord>& images);
  void remove_images(const std::vector<std::string>& names);
  std::vector<ImageRecord> images() const;  // sorted by name

  void put_tiles(const std::vector<TileRecord>& tiles);
  void remove_tiles(const std::vector<std::string>& names);
  std::vector<TileRecord> tiles() const;  // sorted by name

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skysweep::index
