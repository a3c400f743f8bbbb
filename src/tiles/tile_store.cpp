// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_store.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "raster/digest.h"
#include "raster/file_stamp.h"

namespace skysweep::tiles {

namespace fs = std::filesystem;

namespace {

// In the order of writing: a tile whose dem exists is complete.
constexpr std::array kLayers = {"color", "confidence", "mask", "dem_max", "dem"};

bool has_layer(TileKey key, std::string_view layer) { return layer != "dem_max" || key.level > 0; }

// "x-7" or "y4" -> the number, if the name is one that path() makes.
std::optional<int> index_from(const std::string& name, char axis) {
  const std::string as_key = axis == 'x' ? "l0" + name + "y0" : "l0x0" + name;
  const std::optional<TileKey> key = TileKey::parse(as_key);
  if (!key) return std::nullopt;
  return axis == 'x' ? key->x : key->y;
}

// Two numbers as they are read back: to the last bit.
std::string text_of(const std::optional<SearchedHeights>& heights) {
  if (!heights) return {};
  const auto shortest = [](double value) {
    std::array<char, 32> digits;
    return std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  };
  return shortest(heights->low) + " " + shortest(heights->high);
}

std::optional<SearchedHeights> heights_in(const std::string& text) {
  SearchedHeights heights;
  const char* const end = text.data() + text.size();
  const auto low = std::from_chars(text.data(), end, heights.low);
  if (low.ec != std::errc() || low.ptr == end || *low.ptr != ' ') return std::nullopt;
  const auto high = std::from_chars(low.ptr + 1, end, heights.high);
  if (high.ec != std::errc() || high.ptr != end) return std::nullopt;
  return heights;
}

}  // namespace

TileStore::TileStore(fs::path folder, Lattice lattice, std::string crs_wkt, std::string vertical_reference,
                     std::string software)
    : folder_(std::move(folder)),
      lattice_(lattice),
      crs_wkt_(std::move(crs_wkt)),
      vertical_reference_(std::move(vertical_reference)),
      software_(std::move(software)) {}

fs::path TileStore::path(TileKey key, const std::string& layer) const {
  if (key.is_top()) return folder_ / layer / "top.tif";
  return folder_ / layer / ("l" + std::to_string(key.level)) / ("x" + std::to_string(key.x)) /
         ("y" + std::to_string(key.y) + ".tif");
}

raster::Labels TileStore::labels(const std::string& layer, const std::string& input_digest) const {
  raster::Labels labels{
      .content = "", .units = "metre", .vertical_reference = "", .software = software_, .input_digest = input_digest};
  if (layer == "dem") {
    labels.content = "surface height";
    labels.vertical_reference = vertical_reference_;
  } else if (layer == "dem_max") {
    labels.content = "highest surface height within the cell";
    labels.vertical_reference = vertical_reference_;
  } else if (layer == "confidence") {
    labels.content = "standard deviation of the surface height";
  } else if (layer == "color") {
    labels.content = "colour (sRGB)";
    labels.units = "";
  } else {
    SKY_CHECK_EQ(layer, "mask");
    labels.content = "source of the height: 0 none, 1 measured, 2 filled, 3 none but colour from a plane";
    labels.units = "";
  }
  return labels;
}

raster::GeoReference TileStore::georeference(TileKey key, const LevelPlan* plan) const {
  if (!key.is_top()) return {crs_wkt_, lattice_.north_west_corner(key), lattice_.cell_size_m(key.level)};
  SKY_CHECK(plan != nullptr);
  // The top is as large as two tiles of the level below it.
  const TileKey south_west = plan->top_south_west;
  const TileKey north_west{south_west.level, south_west.x, south_west.y + 1};
  return {crs_wkt_, lattice_.north_west_corner(north_west), lattice_.cell_size_m(south_west.level + 1)};
}

void TileStore::write(TileKey key, const Tile& tile, const std::string& input_digest, const LevelPlan* plan) const {
  const raster::GeoReference place = georeference(key, plan);
  const auto write_layer = [&](const std::string& layer, const auto& values) {
    SKY_CHECK_EQ(values.width(), lattice_.tile_cells);
    SKY_CHECK_EQ(values.height(), lattice_.tile_cells);
    raster::Labels labelled = labels(layer, input_digest);
    labelled.searched_heights = text_of(tile.searched);
    raster::write_geotiff(path(key, layer), raster::Raster{values, place, labelled});
  };
  write_layer("color", tile.color);
  write_layer("confidence", tile.confidence);
  write_layer("mask", tile.mask);
  if (has_layer(key, "dem_max")) write_layer("dem_max", tile.dem_max);
  write_layer("dem", tile.dem);
}

std::optional<Tile> TileStore::read(TileKey key) const {
  if (!has_all_files(key)) return std::nullopt;
  std::vector<std::string> digests;
  const auto take = [&](const std::string& layer, auto raster) {
    const int cells = lattice_.tile_cells;
    const bool in_place = key.is_top() || (raster.georeference.north_west_corner == lattice_.north_west_corner(key) &&
                                           raster.georeference.cell_m == lattice_.cell_size_m(key.level));
    if (raster.values.width() != cells || raster.values.height() != cells || !in_place)
      throw bad_input(path(key, layer).string() +
                      " is no tile of this project: its size or place is another; remove it");
    digests.push_back(raster.labels.input_digest);
    return std::move(raster.values);
  };
  Tile tile;
  tile.color = take("color", raster::read_color_raster(path(key, "color")));
  tile.confidence = take("confidence", raster::read_float_raster(path(key, "confidence")));
  tile.mask = take("mask", raster::read_class_raster(path(key, "mask")));
  if (has_layer(key, "dem_max")) tile.dem_max = take("dem_max", raster::read_float_raster(path(key, "dem_max")));
  raster::Raster<float> dem = raster::read_float_raster(path(key, "dem"));
  tile.searched = heights_in(dem.labels.searched_heights);
  tile.dem = take("dem", std::move(dem));
  const bool one_writing = std::all_of(digests.begin(), digests.end(), [&](const auto& d) { return d == digests[0]; });
  if (!one_writing) return std::nullopt;
  return tile;
}

std::optional<TileOrigin> TileStore::origin(TileKey key) const {
  if (!has_all_files(key)) return std::nullopt;
  try {
    const raster::Labels of_dem = raster::read_labels(path(key, "dem"));
    for (const char* layer : kLayers) {
      if (!has_layer(key, layer)) continue;
      const raster::Labels found = raster::read_labels(path(key, layer));
      if (found.input_digest != of_dem.input_digest || found.searched_heights != of_dem.searched_heights)
        return std::nullopt;
    }
    return TileOrigin{of_dem.input_digest, heights_in(of_dem.searched_heights)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<std::string> TileStore::input_digest(TileKey key) const {
  std::optional<TileOrigin> found = origin(key);
  if (!found) return std::nullopt;
  return std::move(found->input_digest);
}

std::optional<std::string> TileStore::stamp(TileKey key) const {
  raster::Digest digest;
  for (const char* layer : kLayers) {
    if (!has_layer(key, layer)) continue;
    const std::optional<std::string> of_file = raster::file_stamp(path(key, layer));
    if (!of_file) return std::nullopt;
    digest.add_field(*of_file);
  }
  return digest.hex();
}

std::string TileStore::checksum(TileKey key) const {
  raster::Digest digest;
  for (const char* layer : kLayers)
    if (has_layer(key, layer)) digest.add_field(raster::digest_of_file(path(key, layer)));
  return digest.hex();
}

bool TileStore::has_all_files(TileKey key) const {
  return std::all_of(kLayers.begin(), kLayers.end(), [&](const char* layer) {
    std::error_code ignored;
    return !has_layer(key, layer) || fs::exists(path(key, layer), ignored);
  });
}

void TileStore::collect_keys(const std::string& layer, int level, std::vector<TileKey>& keys) const {
  std::error_code error;
  // Absent folders are empty lists.
  for (const fs::directory_entry& column :
       fs::directory_iterator(folder_ / layer / ("l" + std::to_string(level)), error)) {
    const std::optional<int> x = index_from(column.path().filename().string(), 'x');
    if (!x) continue;
    for (const fs::directory_entry& file : fs::directory_iterator(column.path(), error)) {
      const std::optional<int> y = index_from(file.path().stem().string(), 'y');
      if (y && file.path().extension() == ".tif") keys.push_back({level, *x, *y});
    }
  }
}

std::vector<TileKey> TileStore::list(int level) const {
  std::vector<TileKey> keys;
  collect_keys("dem", level, keys);
  std::erase_if(keys, [&](TileKey key) { return !has_all_files(key); });
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<TileKey> TileStore::list_remains(int level) const {
  std::vector<TileKey> keys;
  for (const char* layer : kLayers) collect_keys(layer, level, keys);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

void TileStore::remove(TileKey key) const {
  // The dem first: from then on the tile does not exist.
  for (auto layer = kLayers.rbegin(); layer != kLayers.rend(); ++layer) {
    std::error_code error;
    fs::remove(path(key, *layer), error);
    if (error) throw failure("cannot remove " + path(key, *layer).string() + ": " + error.message());
  }
}

}  // namespace skysweep::tiles
