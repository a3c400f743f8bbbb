// SPDX-License-Identifier: Apache-2.0
// A raster that is computed while it is read (GDAL's VRT): pieces joined on one lattice, brought to another lattice or
// reference system, cut, written as any format that GDAL writes. It holds no cells, so memory is a few blocks however
// large it is. A cell's value does not depend on which window is read or written: whatever windows overlap agree in
// every bit.
//
//   VirtualRaster map = VirtualRaster::mosaic(pieces);
//   VirtualRaster mercator = map.resampled({.georeference = grid, .width = 4096, .height = 4096});
//   Array2d<float> heights = mercator.floats({0, 0, 256, 256});
//
// Not safe for several threads at once. Reading throws Error(bad_input) naming a source that cannot be read.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "raster/cog.h"

namespace skysweep::raster {

enum class Resampling {
  nearest,   // the value of the cell in which the new cell's centre lies
  bilinear,  // of 2 x 2 cells; of all below the new cell where that is larger
  cubic,     // of 4 x 4, sharper, overshoots at steps
  average,   // of all below the new cell, by area
};

// The lattice to come to. `scale`: side of a cell of the old lattice over that of the new one, on the ground; given
// once for the whole raster, because GDAL would estimate it for each block, differently.
struct Resample {
  GeoReference georeference;
  int width = 0;
  int height = 0;
  Resampling method = Resampling::bilinear;
  double scale = 1;
};

struct Window {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

// Called with the share that is done, 0 to 1; false asks to stop.
using OnProgress = std::function<bool(double)>;

// Thrown by what was asked to stop; nothing is left behind.
struct Stopped {};

class VirtualRaster {
 public:
  // The sources of a mosaic joined; what none covers is no-data.
  static VirtualRaster mosaic(const Cog& cog);

  CogKind kind() const;
  int width() const;
  int height() const;

  // No-data neighbours do not count; a new cell with no known cell below it is no-data. Classes need `nearest`. Heights
  // are carried over as they are: reference systems are taken without their vertical part. Throws Error(failed).
  VirtualRaster resampled(const Resample& to) const;

  // The part inside the window, which must lie in the raster.
  VirtualRaster window(const Window& window) const;

  // Floats with another number for no-data than NaN.
  VirtualRaster with_no_data(double value) const;

  // One call for the kind of cells that the raster has.
  Array2d<float> floats(const Window& window) const;
  Array2d<Rgba8> colors(const Window& window) const;
  Array2d<std::uint8_t> classes(const Window& window) const;

  // Writes all of it with a driver of GDAL ("COG", "GTiff", "AAIGrid"), and the labels with it as far as the format
  // takes them. Not atomic. Throws Error(failed) naming `blamed`, and Stopped.
  void write(const std::filesystem::path& path, const std::string& driver, const std::vector<std::string>& options,
             const Labels& labels, const std::filesystem::path& blamed, const OnProgress& progress = {}) const;

 private:
  struct State;
  explicit VirtualRaster(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

// All of the raster as a Cloud Optimized GeoTIFF (raster/cog.h). Atomic. Throws as VirtualRaster::write does.
void write_cog(const std::filesystem::path& path, const VirtualRaster& raster, const Labels& labels,
               const OnProgress& progress = {});

}  // namespace skysweep::raster
