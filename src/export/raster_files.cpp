// SPDX-License-Identifier: Apache-2.0
#include "export/raster_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/error.h"
#include "export/labels_file.h"

namespace skysweep::exports {

namespace {

using raster::CogKind;

constexpr double kTextNoData = -9999;
constexpr int kDecimals = 4;  // of text: a tenth of a millimetre

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return (a - (((a % b) + b) % b)) / b; }

bool is_float(CogKind kind) { return kind == CogKind::values || kind == CogKind::deviations; }

template <typename T, typename Known>
bool any_known(const Array2d<T>& cells, Known known) {
  return std::any_of(cells.begin(), cells.end(), known);
}

// The cells of the range as a GeoTIFF; nothing is written if none of them is known.
bool write_tile(const MapRaster& map, const CellRange& range, const std::filesystem::path& path) {
  const raster::GeoReference place{
      map.crs_wkt, {static_cast<double>(range.west) * map.cell, static_cast<double>(range.north) * map.cell}, map.cell};
  const raster::Window window = map.window_of(range);
  const auto write = [&](auto cells, auto known) {
    if (!any_known(cells, known)) return false;
    raster::write_geotiff(path, raster::Raster{std::move(cells), place, map.labels});
    return true;
  };
  if (map.whole.kind() == CogKind::colors) return write(map.whole.colors(window), [](Rgba8 c) { return c.a > 0; });
  if (map.whole.kind() == CogKind::classes)
    return write(map.whole.classes(window), [](std::uint8_t c) { return c != 0; });
  return write(map.whole.floats(window), [](float z) { return std::isfinite(z); });
}

void require_numbers(const MapRaster& map) {
  if (map.whole.kind() == CogKind::colors)
    throw usage_error(
        "a text format holds one number for each cell, not colours: choose --layer dsm, confidence or "
        "mask, or another --format.");
}

// A text file that notices a full disk.
class TextFile {
 public:
  TextFile(const std::filesystem::path& path, const std::filesystem::path& blamed)
      : out_(path, std::ios::binary), blamed_(blamed) {}
  void add(const std::string& text) {
    out_ << text;
    if (!out_) throw failure("cannot write " + blamed_.string() + ": the disk is full or not writable");
  }
  void close() {
    out_.close();
    add("");
  }

 private:
  std::ofstream out_;
  std::filesystem::path blamed_;
};

}  // namespace

void write_cog(const MapRaster& map, const Destination& to, const raster::OnProgress& progress) {
  raster::write_cog(to.result(), map.part(), map.labels, progress);
}

int write_geotiff_tiles(const MapRaster& map, const TileSize& size, const Destination& to,
                        const raster::OnProgress& progress) {
  const auto index = [&](std::int64_t cell) { return floor_div(cell, size.cells); };
  const std::int64_t west = index(map.cells.west), east = index(map.cells.east - 1);
  const std::int64_t south = index(map.cells.south), north = index(map.cells.north - 1);
  const double total = static_cast<double>((east - west + 1) * (north - south + 1));
  int written = 0;
  std::int64_t done = 0;
  for (std::int64_t y = north; y >= south; --y)
    for (std::int64_t x = west; x <= east; ++x) {
      const CellRange tile{std::max(map.cells.west, x * size.cells - size.overlap),
                           std::max(map.cells.south, y * size.cells - size.overlap),
                           std::min(map.cells.east, (x + 1) * size.cells + size.overlap),
                           std::min(map.cells.north, (y + 1) * size.cells + size.overlap)};
      const std::string name = "x" + std::to_string(x) + "_y" + std::to_string(y) + ".tif";
      written += write_tile(map, tile, to.result() / name);
      if (progress && !progress(static_cast<double>(++done) / total)) throw raster::Stopped{};
    }
  write_labels_json(map, {{"TILES", std::to_string(written)}}, to.result() / kLabelsFile);
  return written;
}

void write_ascii_grid(const MapRaster& map, const Destination& to, const raster::OnProgress& progress) {
  require_numbers(map);
  const raster::VirtualRaster part = is_float(map.whole.kind()) ? map.part().with_no_data(kTextNoData) : map.part();
  std::vector<std::string> options;
  if (is_float(map.whole.kind())) options.push_back("DECIMAL_PRECISION=" + std::to_string(kDecimals));
  const std::filesystem::path grid = to.scratch() / "grid.asc";  // GDAL's own side files stay here
  part.write(grid, "AAIGrid", options, {}, to.path(), progress);
  std::filesystem::rename(grid, to.result());
  write_side_files(map, is_float(map.whole.kind()) ? "-9999" : "0", to);
}

std::int64_t write_xyz_text(const MapRaster& map, const Destination& to, const raster::OnProgress& progress) {
  require_numbers(map);
  constexpr int kRows = 128;  // as GDAL's blocks
  // A thousandth of a cell and finer.
  const int place_decimals = std::clamp(3 - static_cast<int>(std::floor(std::log10(map.cell))), 3, 12);
  TextFile file(to.result(), to.path());
  const raster::Window all = map.window_of(map.cells);
  std::int64_t points = 0;
  char line[128];
  for (int row = 0; row < all.height; row += kRows) {
    const raster::Window strip{all.column, all.row + row, all.width, std::min(kRows, all.height - row)};
    Array2d<float> values;
    if (is_float(map.whole.kind())) {
      values = map.whole.floats(strip);
    } else {
      const Array2d<std::uint8_t> codes = map.whole.classes(strip);
      values = Array2d<float>(strip.width, strip.height);
      std::transform(codes.begin(), codes.end(), values.begin(),
                     [](std::uint8_t code) { return code ? static_cast<float>(code) : std::nanf(""); });
    }
    std::string text;
    for (int y = 0; y < strip.height; ++y)
      for (int x = 0; x < strip.width; ++x) {
        if (!std::isfinite(values(x, y))) continue;
        std::snprintf(line, sizeof line, "%.*f %.*f %.*f\n", place_decimals,
                      (static_cast<double>(map.cells.west + x) + 0.5) * map.cell, place_decimals,
                      (static_cast<double>(map.cells.north - 1 - row - y) + 0.5) * map.cell,
                      is_float(map.whole.kind()) ? kDecimals : 0, values(x, y));
        text += line;
        ++points;
      }
    file.add(text);
    if (progress && !progress(std::min(1.0, (row + kRows) / static_cast<double>(all.height)))) throw raster::Stopped{};
  }
  file.close();
  write_side_files(map, "absent", to);
  return points;
}

}  // namespace skysweep::exports
