// SPDX-License-Identifier: Apache-2.0
// The project's catalogue on disk: a GeoPackage that QGIS and ogrinfo open. Layers: `images` (footprint polygon, pose,
// camera, status, reason), `cameras` (table), `tiles` (rectangle, digest, views, seconds), `products` (table).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/box.h"
#include "index/image_record.h"

namespace skysweep::index {

// A tile as the catalogue lists it; `name` as tiles::TileKey prints it. Above level 0 the views are the tiles below.
struct TileRecord {
  std::string name;
  int level = 0;
  Box2d extent;
  std::string input_digest;        // of everything it was computed from
  std::vector<std::string> views;  // names of the photographs it was computed from
  double valid_share = 0;          // share of cells with a height
  double z_low = 0, z_high = 0;    // heights that were searched; both 0: none were found
  double seconds = 0;
  std::string candidates_digest = {};          // of all photographs that might show it: equal, and nothing is to do
  std::vector<std::string> view_digests = {};  // of each view: tells which of them has changed
  std::string checksum = {};                   // of the bytes of its files; empty: it has none, nothing is known there
  std::string stamp = {};                      // sizes and times of its files
  friend bool operator==(const TileRecord&, const TileRecord&) = default;
};

// A file made from the tiles: what it was made from, and its size and times.
struct ProductRecord {
  std::string name;
  std::string digest;
  std::string stamp;
};

// Changes go to disk in transactions: each function is one. Throws Error(failed) if the file cannot be written and
// Error(bad_input) if it is damaged. Not safe for several threads at once.
class Catalogue {
 public:
  // Opens the file, or makes it when it is missing, with this CRS (a local frame is one too). The file's own checks are
  // run: pages that do not fit together are damage, too.
  Catalogue(const std::filesystem::path& path, const std::string& crs_wkt);
  // For looking only: the file must exist; it may lie on a read-only disk.
  static Catalogue open_existing(const std::filesystem::path& path);
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

  void put_products(const std::vector<ProductRecord>& products);
  void remove_products(const std::vector<std::string>& names);
  std::vector<ProductRecord> products() const;  // sorted by name

 private:
  struct Impl;
  explicit Catalogue(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace skysweep::index
