// SPDX-License-Identifier: Apache-2.0
// Labelled rasters as GeoTIFF files (through GDAL). North-up: row 0 is the northernmost; a value stands for the centre
// of its cell. Files are written whole or not at all (raster/atomic_file.h) and hold no time stamps, so that the same
// values always give the same bytes. All functions may be called from several threads at once (for different files).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/array2d.h"
#include "core/box.h"
#include "core/color.h"

namespace skysweep::raster {

// Where a raster lies in the world.
struct GeoReference {
  std::string crs_wkt;      // from raster/crs.h; never empty
  Vec2d north_west_corner;  // outer corner of the north-west cell, metres
  double cell_m = 1;        // side of a cell

  Vec2d cell_center(int column, int row) const {
    return {north_west_corner.x + (column + 0.5) * cell_m, north_west_corner.y - (row + 0.5) * cell_m};
  }
};

// What the numbers mean: written into every file, so that nothing is unlabelled.
struct Labels {
  std::string content;  // e.g. "surface height"
  std::string units;    // e.g. "metre"; empty for colours and classes
  std::string
      vertical_reference;    // e.g. "EGM96 height" or "unknown: as in the photographs' poses"; empty if no heights
  std::string software;      // "skysweep 0.1.0"
  std::string input_digest;  // digest of everything the raster was computed from
  std::string searched_heights = {};  // "LOW HIGH", metres: between which a surface was looked for; empty if unknown
};

template <typename T>
struct Raster {
  Array2d<T> values;
  GeoReference georeference;
  Labels labels;

  Box2d extent() const {
    const Vec2d nw = georeference.north_west_corner;
    const double cell = georeference.cell_m;
    return {{nw.x, nw.y - values.height() * cell}, {nw.x + values.width() * cell, nw.y}};
  }
};

// Float32 with no-data NaN; RGBA with alpha 0 where no colour is known; uint8 classes with no-data 0.
// Throws Error(failed) naming the file: unwritable folder, disk full.
void write_geotiff(const std::filesystem::path& path, const Raster<float>& raster);
void write_geotiff(const std::filesystem::path& path, const Raster<Rgba8>& raster);
void write_geotiff(const std::filesystem::path& path, const Raster<std::uint8_t>& raster);

// What write_geotiff would write, as bytes.
std::string geotiff_bytes(const Raster<float>& raster);

// Reads a raster of any GDAL format that is north-up with square cells; no-data values of floats become NaN, colours
// without alpha become opaque, a one-band image becomes grey. Throws Error(bad_input) naming the file: missing,
// damaged, rotated, wrong kind of values.
Raster<float> read_float_raster(const std::filesystem::path& path);
Raster<Rgba8> read_color_raster(const std::filesystem::path& path);
Raster<std::uint8_t> read_class_raster(const std::filesystem::path& path);

// The labels alone, without reading the values. Throws Error(bad_input) as above.
Labels read_labels(const std::filesystem::path& path);

}  // namespace skysweep::raster
