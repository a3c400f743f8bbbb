// SPDX-License-Identifier: Apache-2.0
#include "export/map_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"
#include "export/mosaic.h"
#include "export/shading.h"
#include "raster/crs.h"
#include "raster/digest.h"

namespace skysweep::exports {

namespace {

using raster::CogKind;
using tiles::TileKey;
using tiles::TileStore;

constexpr std::int64_t kBlockCells = 512;  // a multiple of GDAL's blocks and of web tiles
constexpr int kMarginCells = 8;            // more than any resampling looks beyond a cell, in cells of the source
constexpr double kMostReduction = 8;       // of a level's cells to those of an export: a block reads 64 blocks
constexpr std::int64_t kMostCells = std::numeric_limits<int>::max() - (1 << 20);

std::int64_t floor_to(std::int64_t n, std::int64_t step) { return n - ((n % step) + step) % step; }
std::int64_t ceil_to(std::int64_t n, std::int64_t step) { return -floor_to(-n, step); }

std::string stored_layer(Layer layer) {
  switch (layer) {
    case Layer::ortho: return "color";
    case Layer::confidence: return "confidence";
    case Layer::mask: return "mask";
    default: return "dem";
  }
}

CogKind stored_kind(Layer layer) {
  switch (layer) {
    case Layer::ortho: return CogKind::colors;
    case Layer::confidence: return CogKind::deviations;
    case Layer::mask: return CogKind::classes;
    default: return CogKind::values;
  }
}

bool is_shaded(Layer layer) { return layer == Layer::hillshade || layer == Layer::relief; }

CellRange cells_of(TileKey key, int tile_cells) {
  const std::int64_t west = static_cast<std::int64_t>(key.x) * tile_cells;
  const std::int64_t south = static_cast<std::int64_t>(key.y) * tile_cells;
  return {west, south, west + tile_cells, south + tile_cells};
}

// Cells whose centres lie in the box.
CellRange cells_within(const Box2d& box, double cell) {
  const auto first_at_or_after = [&](double x) { return static_cast<std::int64_t>(std::ceil(x / cell - 0.5)); };
  return {first_at_or_after(box.min.x), first_at_or_after(box.min.y), first_at_or_after(box.max.x),
          first_at_or_after(box.max.y)};
}

CellRange intersection(const CellRange& a, const CellRange& b) {
  return {std::max(a.west, b.west), std::max(a.south, b.south), std::min(a.east, b.east), std::min(a.north, b.north)};
}

Box2d box_of(const CellRange& r, double cell) {
  const auto at = [&](std::int64_t n) { return static_cast<double>(n) * cell; };
  return {{at(r.west), at(r.south)}, {at(r.east), at(r.north)}};
}

raster::GeoReference place_of(const CellRange& r, const std::string& crs_wkt, double cell) {
  return {crs_wkt, {static_cast<double>(r.west) * cell, static_cast<double>(r.north) * cell}, cell};
}

void require_countable(const CellRange& r, double cell) {
  if (r.width() <= kMostCells && r.height() <= kMostCells) return;
  char text[40];
  std::snprintf(text, sizeof text, "%g", cell);
  throw usage_error(std::string("with cells of ") + text + " the map has too many of them; use a larger --cell");
}

// One level of the map: its tiles, and the cells they span.
struct Level {
  int level = 0;
  double cell_m = 0;
  std::vector<TileKey> tiles;
  CellRange cells;
};

Level level_of(const TileStore& store, int number) {
  Level level{number, store.lattice().cell_size_m(number), store.list(number), {}};
  if (level.tiles.empty()) return level;
  level.cells = cells_of(level.tiles.front(), store.lattice().tile_cells);
  for (const TileKey key : level.tiles) {
    const CellRange tile = cells_of(key, store.lattice().tile_cells);
    level.cells = {std::min(level.cells.west, tile.west), std::min(level.cells.south, tile.south),
                   std::max(level.cells.east, tile.east), std::max(level.cells.north, tile.north)};
  }
  return level;
}

// Whether every tile of the finer level has its parent here: an interrupted run may have left some out.
bool is_parent_of_all(const Level& coarse, const Level& fine) {
  return std::all_of(fine.tiles.begin(), fine.tiles.end(), [&](TileKey key) {
    return std::binary_search(coarse.tiles.begin(), coarse.tiles.end(), key.parent());
  });
}

// The coarsest level with cells not larger than `cell_m`: reading a coarse export takes no more than a fine one.
Level level_for(const TileStore& store, double cell_m) {
  Level level = level_of(store, 0);
  while (2 * level.cell_m <= cell_m * 1.0001) {
    Level next = level_of(store, level.level + 1);
    if (next.tiles.empty() || !is_parent_of_all(next, level)) break;
    level = std::move(next);
  }
  const std::int64_t two_tiles = 2 * store.lattice().tile_cells;
  const bool is_highest = level.cells.width() <= two_tiles && level.cells.height() <= two_tiles;
  if (!is_highest && cell_m > kMostReduction * level.cell_m)
    throw bad_input(
        "the map's coarser levels are not complete, and without them so coarse an export would have to load "
        "all of the map: run the project again, or ask for smaller cells");
  return level;
}

raster::VirtualRaster mosaic_of(const TileStore& store, const Level& level, const std::string& layer, CogKind kind) {
  require_countable(level.cells, level.cell_m);
  raster::Cog cog;
  cog.kind = kind;
  cog.width = static_cast<int>(level.cells.width());
  cog.height = static_cast<int>(level.cells.height());
  cog.georeference = place_of(level.cells, store.crs_wkt(), level.cell_m);
  const int cells = store.lattice().tile_cells;
  for (const TileKey key : level.tiles) {
    const CellRange tile = cells_of(key, cells);
    cog.sources.push_back({store.path(key, layer), static_cast<int>(tile.west - level.cells.west),
                           static_cast<int>(level.cells.north - tile.north), cells, cells});
  }
  return raster::VirtualRaster::mosaic(cog);
}

// The heights that the colours of a relief span: from all of the map, so that windows of it look alike.
raster::HeightSpan span_of_map(const TileStore& store) {
  constexpr std::size_t kEnoughTiles = 16;
  Level level = level_of(store, 0);
  while (level.tiles.size() > kEnoughTiles) {
    Level next = level_of(store, level.level + 1);
    if (next.tiles.empty()) break;
    level = std::move(next);
  }
  std::vector<float> heights;
  for (const TileKey key : level.tiles) {
    const Array2d<float> dem = raster::read_float_raster(store.path(key, "dem")).values;
    std::copy_if(dem.begin(), dem.end(), std::back_inserter(heights), [](float z) { return std::isfinite(z); });
  }
  return raster::usual_span(heights);
}

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string digest_of(const TileStore& store, const MapRequest& request, const MapRaster& map, const Box2d& area,
                      const std::string& content) {
  raster::Digest digest;
  digest.add_field(to_string(request.layer)).add_field(map.crs_wkt).add_field(text_of(map.cell)).add_field(content);
  digest.add_field(std::to_string(static_cast<int>(request.resampling.value_or(raster::Resampling::bilinear))));
  for (const std::int64_t n : {map.cells.west, map.cells.south, map.cells.east, map.cells.north})
    digest.add_field(std::to_string(n));
  for (const TileKey key : store.list(0))
    if (store.lattice().extent(key).intersects(area))
      digest.add_field(key.name()).add_field(store.input_digest(key).value_or(""));
  return digest.hex();
}

std::string shaded_content(Layer layer, const raster::HeightSpan& span) {
  if (layer == Layer::hillshade) return "hillshade of the surface, light from the north-west";
  char text[120];
  std::snprintf(text, sizeof text, "colours of the surface height from %.2f m (green) to %.2f m (white), shaded",
                span.low_m, span.high_m);
  return text;
}

void require_sensible(const MapRequest& request, bool resampled) {
  if (request.cell && !(*request.cell > 0 && std::isfinite(*request.cell)))
    throw usage_error("--cell must be a positive number, the side of a cell in units of the output's CRS.");
  if (request.resampling && !resampled)
    throw usage_error("--resampling has no effect on the map's own cells: leave it away, or give --cell or --crs.");
  if (request.layer == Layer::mask &&
      request.resampling.value_or(raster::Resampling::nearest) != raster::Resampling::nearest)
    throw usage_error("--resampling of the mask is nearest: its codes have no mean.");
  if (request.relief_span_m && request.layer != Layer::relief)
    throw usage_error("--relief-range has an effect with --layer relief only; leave it away.");
  if (request.relief_span_m && !(request.relief_span_m->low_m < request.relief_span_m->high_m))
    throw usage_error("--relief-range takes LOW,HIGH with LOW below HIGH.");
}

}  // namespace

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names = {"dsm", "ortho", "confidence", "mask", "hillshade", "relief"};
  return names;
}

std::string to_string(Layer layer) { return layer_names()[static_cast<std::size_t>(layer)]; }

raster::Window MapRaster::window_of(const CellRange& r) const {
  return {static_cast<int>(r.west - whole_cells.west), static_cast<int>(whole_cells.north - r.north),
          static_cast<int>(r.width()), static_cast<int>(r.height())};
}

double units_per_metre(const TileStore& store, const std::string& crs_wkt, const Box2d& extent) {
  const Vec2d middle = 0.5 * (extent.min + extent.max);
  const double reach = std::max(1.0, 0.01 * std::max(extent.width(), extent.height()));
  const Box2d around{{middle.x - reach, middle.y - reach}, {middle.x + reach, middle.y + reach}};
  const Box2d there = raster::transformed_extent(store.crs_wkt(), crs_wkt, around);
  return there.height() / around.height();  // degrees of latitude where there are degrees
}

double usual_cell(const TileStore& store, const std::string& crs_wkt, const Box2d& extent) {
  const double exact = store.lattice().cell_m * units_per_metre(store, crs_wkt, extent);
  char two_digits[40];
  std::snprintf(two_digits, sizeof two_digits, "%.1e", exact);
  return std::strtod(two_digits, nullptr);
}

MapRaster map_raster(const TileStore& store, const MapRequest& request, const std::filesystem::path& scratch,
                     const raster::OnProgress& progress) {
  const double map_cell = store.lattice().cell_m;
  const std::string crs = request.crs_wkt.value_or(store.crs_wkt());
  const bool other_crs = request.crs_wkt && !raster::same_crs(crs, store.crs_wkt());
  const bool resampled = other_crs || (request.cell && *request.cell != map_cell);
  require_sensible(request, resampled);

  const Box2d known = known_extent(store);
  if (known.empty()) throw bad_input("the map is empty: nothing is known anywhere; run the project first");
  Box2d area = known;
  if (request.area)
    area = {{std::max(known.min.x, request.area->min.x), std::max(known.min.y, request.area->min.y)},
            {std::min(known.max.x, request.area->max.x), std::min(known.max.y, request.area->max.y)}};
  const auto nothing_there = [] { return bad_input("the map has nothing in the area that was asked for (--aoi)"); };
  if (area.empty()) throw nothing_there();

  const double scale = other_crs ? units_per_metre(store, crs, known) : 1;
  const double cell = request.cell ? *request.cell : other_crs ? usual_cell(store, crs, known) : map_cell;
  const Level level = level_for(store, cell / scale);
  const auto to_output = [&](const Box2d& box) {
    return other_crs ? raster::transformed_extent(store.crs_wkt(), crs, box) : box;
  };
  const CellRange cells = cells_within(to_output(area), cell);
  if (cells.empty()) throw nothing_there();

  raster::VirtualRaster source = mosaic_of(store, level, stored_layer(request.layer), stored_kind(request.layer));
  raster::HeightSpan span;
  if (is_shaded(request.layer)) {
    if (request.layer == Layer::relief) span = request.relief_span_m ? *request.relief_span_m : span_of_map(store);
    // Blocks that are read reach beyond the cells asked for.
    const CellRange blocks{floor_to(cells.west, kBlockCells), floor_to(cells.south, kBlockCells),
                           ceil_to(cells.east, kBlockCells), ceil_to(cells.north, kBlockCells)};
    Box2d needed = box_of(blocks, cell);
    if (other_crs) needed = raster::transformed_extent(crs, store.crs_wkt(), needed);
    const double margin = kMarginCells * level.cell_m;
    needed = {{needed.min.x - margin, needed.min.y - margin}, {needed.max.x + margin, needed.max.y + margin}};
    const CellRange shaded = intersection(cells_within(needed, level.cell_m), level.cells);
    const raster::Window window{static_cast<int>(shaded.west - level.cells.west),
                                static_cast<int>(level.cells.north - shaded.north), static_cast<int>(shaded.width()),
                                static_cast<int>(shaded.height())};
    const std::filesystem::path picture = scratch / "shaded.tif";
    write_shaded(source, place_of(level.cells, store.crs_wkt(), level.cell_m), window,
                 request.layer == Layer::relief ? std::optional(span) : std::nullopt, picture, progress);
    raster::Cog cog{CogKind::colors,
                    source.width(),
                    source.height(),
                    place_of(level.cells, store.crs_wkt(), level.cell_m),
                    {},
                    {{picture, window.column, window.row, window.width, window.height}}};
    source = raster::VirtualRaster::mosaic(cog);
  }

  CellRange whole = level.cells;
  if (resampled) {
    const CellRange all = cells_within(to_output(known), cell);
    whole = {floor_to(all.west - 1, kBlockCells), floor_to(all.south - 1, kBlockCells),
             ceil_to(all.east + 1, kBlockCells), ceil_to(all.north + 1, kBlockCells)};
    require_countable(whole, cell);
    const raster::Resampling method = request.resampling.value_or(
        request.layer == Layer::mask ? raster::Resampling::nearest : raster::Resampling::bilinear);
    source = source.resampled({place_of(whole, crs, cell), static_cast<int>(whole.width()),
                               static_cast<int>(whole.height()), method, level.cell_m * scale / cell});
  }
  MapRaster map{std::move(source), whole, intersection(cells, whole), crs, cell, cell / scale, {}};
  map.labels = store.labels(stored_layer(request.layer), "");
  if (is_shaded(request.layer)) {
    map.labels.content = shaded_content(request.layer, span);
    map.labels.units.clear();
    if (request.layer == Layer::hillshade) map.labels.vertical_reference.clear();
  }
  map.labels.input_digest = digest_of(store, request, map, area, map.labels.content);
  return map;
}

}  // namespace skysweep::exports
