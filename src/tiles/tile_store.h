// SPDX-License-Identifier: Apache-2.0
// Tiles on disk: one GeoTIFF per tile and layer, tiles/<layer>/l0/x-7/y4.tif, the top at tiles/<layer>/top.tif. Every
// file is written atomically. Safe for several threads as long as no two touch the same tile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "raster/geotiff.h"
#include "tiles/lattice.h"
#include "tiles/tile_key.h"

namespace skysweep::tiles {

// Values of the mask layer.
enum class CellSource : std::uint8_t {
  none = 0,      // nothing is known here
  measured = 1,  // height from matching
  filled = 2,    // height from the surroundings
  planar = 3,    // no height; colour from the planar fallback
};

// Between which heights the surface of a tile was looked for, metres.
struct SearchedHeights {
  double low = 0;
  double high = 0;
  friend bool operator==(const SearchedHeights&, const SearchedHeights&) = default;
};

// All layers of one tile, T x T cells each, row 0 in the north.
struct Tile {
  Array2d<float> dem;                            // mean height, metres; NaN = no data
  Array2d<float> dem_max;                        // highest height below the cell; empty at level 0, where it equals dem
  Array2d<Rgba8> color;                          // alpha 0 = no colour
  Array2d<float> confidence;                     // standard deviation of the height, metres; NaN = no data
  Array2d<std::uint8_t> mask;                    // CellSource
  std::optional<SearchedHeights> searched = {};  // goes into the labels: a part of what the tile was made from
};

// What a tile's own files say of where it comes from.
struct TileOrigin {
  std::string input_digest;
  std::optional<SearchedHeights> searched;
};

class TileStore {
 public:
  // `folder` is the project's tiles/ folder; it is made when the first tile is written.
  TileStore(std::filesystem::path folder, Lattice lattice, std::string crs_wkt, std::string vertical_reference,
            std::string software);

  const Lattice& lattice() const { return lattice_; }
  const std::string& crs_wkt() const { return crs_wkt_; }

  // Labels of a layer's files: "dem", "dem_max", "color", "confidence" or "mask".
  raster::Labels labels(const std::string& layer, const std::string& input_digest) const;

  // Writes all layers; `dem` last, so that a tile whose dem exists is complete. `input_digest` goes into every file.
  // For the top tile, `plan` says where it lies.
  void write(TileKey key, const Tile& tile, const std::string& input_digest, const LevelPlan* plan = nullptr) const;

  // Nothing if the tile does not exist or is incomplete: a layer is missing, or its layers have different digests
  // because a crash fell between them. Throws Error(bad_input) naming the file if one is damaged or lies elsewhere.
  std::optional<Tile> read(TileKey key) const;

  // What the tile was written with; nothing if the tile is absent, incomplete or cannot be read.
  std::optional<TileOrigin> origin(TileKey key) const;
  std::optional<std::string> input_digest(TileKey key) const;

  // Sizes and times of the tile's files as one text (raster/file_stamp.h); nothing unless all of them are there.
  std::optional<std::string> stamp(TileKey key) const;

  // Digest of the bytes of the tile's files. Throws Error(bad_input) naming a file that cannot be read.
  std::string checksum(TileKey key) const;

  // Tiles of a level of which all files are on disk, sorted.
  std::vector<TileKey> list(int level) const;

  // Tiles of a level of which any file is on disk, sorted: those that an interrupted removal left incomplete, too.
  std::vector<TileKey> list_remains(int level) const;

  // Removes a tile; nothing happens if it is absent.
  void remove(TileKey key) const;

  std::filesystem::path path(TileKey key, const std::string& layer) const;

 private:
  raster::GeoReference georeference(TileKey key, const LevelPlan* plan) const;
  bool has_all_files(TileKey key) const;
  void collect_keys(const std::string& layer, int level, std::vector<TileKey>& keys) const;

  std::filesystem::path folder_;
  Lattice lattice_;
  std::string crs_wkt_;
  std::string vertical_reference_;
  std::string software_;
};

}  // namespace skysweep::tiles
