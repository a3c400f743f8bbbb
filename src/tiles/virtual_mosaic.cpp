// SPDX-License-Identifier: Apache-2.0
#include "tiles/virtual_mosaic.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "core/check.h"
#include "core/error.h"
#include "raster/atomic_file.h"

namespace skysweep::tiles {

namespace fs = std::filesystem;

namespace {

// The level-0 tiles' rectangle in cells of some level; x eastwards, y northwards, ends exclusive.
struct Window {
  std::int64_t west = 0, south = 0, east = 0, north = 0;
  std::int64_t width() const { return east - west; }
  std::int64_t height() const { return north - south; }
};

Window window_of(TileKey key, int tile_cells) {
  const std::int64_t west = static_cast<std::int64_t>(key.x) * tile_cells;
  const std::int64_t south = static_cast<std::int64_t>(key.y) * tile_cells;
  return {west, south, west + tile_cells, south + tile_cells};
}

Window window_of(const std::vector<TileKey>& finest, int tile_cells) {
  SKY_CHECK(!finest.empty());
  Window all = window_of(finest.front(), tile_cells);
  for (const TileKey key : finest) {
    const Window w = window_of(key, tile_cells);
    all = {std::min(all.west, w.west), std::min(all.south, w.south), std::max(all.east, w.east),
           std::max(all.north, w.north)};
  }
  return all;
}

// Borders of level-0 tiles are borders of cells up to the level at which a tile is one cell.
bool cells_divide(int tile_cells, int level) { return tile_cells % (1 << level) == 0; }

Window at_level(const Window& w, int level) {
  return {w.west >> level, w.south >> level, w.east >> level, w.north >> level};
}

std::string number(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  return out;
}

std::string rectangle(const char* element, std::int64_t column, std::int64_t row, std::int64_t width,
                      std::int64_t height) {
  return std::string("<") + element + " xOff=\"" + std::to_string(column) + "\" yOff=\"" + std::to_string(row) +
         "\" xSize=\"" + std::to_string(width) + "\" ySize=\"" + std::to_string(height) + "\"/>";
}

// One of the files: the tiles of one level seen through the window.
class VirtualRaster {
 public:
  VirtualRaster(const TileStore& store, std::string layer, int level, const Window& level0_window, fs::path path)
      : store_(store),
        layer_(std::move(layer)),
        level_(level),
        window_(at_level(level0_window, level)),
        path_(std::move(path)) {}

  const fs::path& path() const { return path_; }

  std::string text(const std::vector<TileKey>& tiles, const std::vector<fs::path>& overviews,
                   const std::string& digest) const {
    std::string xml = "<VRTDataset rasterXSize=\"" + std::to_string(window_.width()) + "\" rasterYSize=\"" +
                      std::to_string(window_.height()) + "\">\n" + georeference() + metadata(digest);
    for (int band = 1; band <= (is_color() ? 4 : 1); ++band) xml += band_element(band, tiles, overviews);
    return xml + "</VRTDataset>\n";
  }

 private:
  bool is_color() const { return layer_ == "color"; }
  const char* type() const { return is_color() ? "Byte" : "Float32"; }
  std::string relative(const fs::path& to) const { return to.lexically_relative(path_.parent_path()).generic_string(); }

  std::string georeference() const {
    const double cell = store_.lattice().cell_size_m(level_);
    return "  <SRS>" + escaped(store_.crs_wkt()) + "</SRS>\n  <GeoTransform>" +
           number(static_cast<double>(window_.west) * cell) + ", " + number(cell) + ", 0, " +
           number(static_cast<double>(window_.north) * cell) + ", 0, " + number(-cell) + "</GeoTransform>\n";
  }

  std::string metadata(const std::string& digest) const {
    const raster::Labels labels = store_.labels(layer_, digest);
    std::string xml = "  <Metadata>\n";
    for (const auto& [key, value] : {std::pair{"CONTENT", labels.content},
                                     {"VERTICAL_REFERENCE", labels.vertical_reference},
                                     {"INPUT_DIGEST", labels.input_digest},
                                     {"TIFFTAG_SOFTWARE", labels.software}})
      if (!value.empty()) xml += "    <MDI key=\"" + std::string(key) + "\">" + escaped(value) + "</MDI>\n";
    return xml + "  </Metadata>\n";
  }

  std::string band_element(int band, const std::vector<TileKey>& tiles, const std::vector<fs::path>& overviews) const {
    constexpr std::array kChannels = {"Red", "Green", "Blue", "Alpha"};
    std::string xml =
        std::string("  <VRTRasterBand dataType=\"") + type() + "\" band=\"" + std::to_string(band) + "\">\n";
    if (is_color())
      xml += std::string("    <ColorInterp>") + kChannels[static_cast<std::size_t>(band - 1)] + "</ColorInterp>\n";
    else
      xml += "    <NoDataValue>nan</NoDataValue>\n    <UnitType>" + store_.labels(layer_, "").units + "</UnitType>\n";
    for (const TileKey key : tiles) xml += source_element(key, band);
    for (const fs::path& overview : overviews)
      xml += "    <Overview><SourceFilename relativeToVRT=\"1\">" + relative(overview) +
             "</SourceFilename><SourceBand>" + std::to_string(band) + "</SourceBand></Overview>\n";
    return xml + "  </VRTRasterBand>\n";
  }

  // With its properties given, GDAL opens a tile only when its cells are asked for.
  std::string source_element(TileKey key, int band) const {
    const int cells = store_.lattice().tile_cells;
    const Window tile = window_of(key, cells);
    const std::int64_t west = std::max(tile.west, window_.west), east = std::min(tile.east, window_.east);
    const std::int64_t south = std::max(tile.south, window_.south), north = std::min(tile.north, window_.north);
    if (west >= east || south >= north) return {};
    const std::string side = std::to_string(cells);
    return "    <SimpleSource><SourceFilename relativeToVRT=\"1\">" + relative(store_.path(key, layer_)) +
           "</SourceFilename><SourceBand>" + std::to_string(band) + "</SourceBand><SourceProperties RasterXSize=\"" +
           side + "\" RasterYSize=\"" + side + "\" DataType=\"" + type() +
           "\" BlockXSize=\"256\" BlockYSize=\"256\"/>" +
           rectangle("SrcRect", west - tile.west, tile.north - north, east - west, north - south) +
           rectangle("DstRect", west - window_.west, window_.north - north, east - west, north - south) +
           "</SimpleSource>\n";
  }

  const TileStore& store_;
  std::string layer_;
  int level_;
  Window window_;
  fs::path path_;
};

void write_if_changed(const fs::path& path, const std::string& text) {
  std::ifstream in(path, std::ios::binary);
  if (in && std::string(std::istreambuf_iterator<char>(in), {}) == text) return;
  raster::write_bytes_atomically(path, text);
}

// tiles/dem/l1.vrt, beside the folder of the level's tiles.
fs::path overview_path(const TileStore& store, const std::string& layer, int level) {
  return store.path(TileKey::top(), layer).parent_path() / ("l" + std::to_string(level) + ".vrt");
}

void remove_overviews(const TileStore& store, const std::string& layer, int from_level) {
  std::error_code ignored;  // nobody names them any more
  for (int level = from_level; cells_divide(store.lattice().tile_cells, level); ++level)
    fs::remove(overview_path(store, layer, level), ignored);
}

}  // namespace

void remove_virtual_mosaic(const TileStore& store, const std::string& layer, const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw failure("cannot remove " + path.string() + ": " + error.message());
  remove_overviews(store, layer, 1);
}

void write_virtual_mosaic(const TileStore& store, const std::string& layer, const std::vector<TileKey>& finest,
                          const std::vector<TileKey>& parents, const std::string& digest, const fs::path& path) {
  SKY_CHECK(layer == "dem" || layer == "color");
  const int cells = store.lattice().tile_cells;
  const Window window = window_of(finest, cells);
  std::vector<fs::path> overviews;
  for (int level = 1; cells_divide(cells, level); ++level) {
    std::vector<TileKey> tiles;
    std::copy_if(parents.begin(), parents.end(), std::back_inserter(tiles),
                 [&](TileKey key) { return key.level == level; });
    if (tiles.empty()) break;
    const VirtualRaster overview(store, layer, level, window, overview_path(store, layer, level));
    write_if_changed(overview.path(), overview.text(tiles, {}, digest));
    overviews.push_back(overview.path());
  }
  const VirtualRaster whole(store, layer, 0, window, path);
  write_if_changed(path, whole.text(finest, overviews, digest));
  remove_overviews(store, layer, static_cast<int>(overviews.size()) + 1);
}

}  // namespace skysweep::tiles
