// SPDX-License-Identifier: Apache-2.0
#include "export/exr_map.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfTiledOutputPart.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "core/error.h"
#include "export/labels_file.h"

namespace skysweep::exports {

namespace {

constexpr int kTileCells = 256;

struct LinearColor {
  half r, g, b, a;
};

// What one part holds: its name, its channels, and how a window of it becomes cells in the layout of the file.
struct Part {
  const char* name;
  const MapRaster* map;
  Imf::PixelType type;
  std::vector<std::string> channels;
};

// IEC 61966-2-1.
double linear_light(int srgb) {
  const double v = srgb / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

LinearColor linear_color(Rgba8 c) {
  static const std::array<double, 256> light = [] {
    std::array<double, 256> table{};
    for (int i = 0; i < 256; ++i) table[static_cast<std::size_t>(i)] = linear_light(i);
    return table;
  }();
  const double alpha = c.a / 255.0;
  const auto channel = [&](std::uint8_t v) { return half(static_cast<float>(alpha * light[v])); };
  return {channel(c.r), channel(c.g), channel(c.b), half(static_cast<float>(alpha))};
}

Imf::Header header_of(const Part& part) {
  const CellRange& cells = part.map->cells;
  Imf::Header header(static_cast<int>(cells.width()), static_cast<int>(cells.height()));
  header.setName(part.name);
  header.setType(Imf::TILEDIMAGE);
  header.setTileDescription(Imf::TileDescription(kTileCells, kTileCells, Imf::ONE_LEVEL));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : part.channels) header.channels().insert(channel, Imf::Channel(part.type));
  for (const auto& [word, text] : label_words(*part.map)) header.insert(word, Imf::StringAttribute(text));
  const double cell = part.map->cell;
  header.insert("crsWkt", Imf::StringAttribute(part.map->crs_wkt));
  header.insert("cell", Imf::DoubleAttribute(cell));
  header.insert("west", Imf::DoubleAttribute(static_cast<double>(cells.west) * cell));
  header.insert("north", Imf::DoubleAttribute(static_cast<double>(cells.north) * cell));
  if (part.type == Imf::HALF) header.insert("CONTENT", Imf::StringAttribute("colour (linear light, sRGB primaries)"));
  return header;
}

// Cells of a window as the file wants them, in a tile's buffer.
template <typename Cell, typename From, typename Convert>
Array2d<Cell> tile_of(const Array2d<From>& cells, Convert convert) {
  Array2d<Cell> tile(kTileCells, kTileCells);
  for (int row = 0; row < cells.height(); ++row)
    std::transform(cells.row(row), cells.row(row) + cells.width(), tile.row(row), convert);
  return tile;
}

template <typename Cell>
void write_tile(Imf::TiledOutputPart& file, const Part& part, int column, int row, Array2d<Cell> tile) {
  Imf::FrameBuffer buffer;
  constexpr std::size_t kRow = sizeof(Cell) * kTileCells;
  const std::size_t channel_bytes = sizeof(Cell) / part.channels.size();
  char* cells = reinterpret_cast<char*>(tile.data());
  for (std::size_t i = 0; i < part.channels.size(); ++i)
    buffer.insert(part.channels[i],
                  Imf::Slice(part.type, cells + i * channel_bytes, sizeof(Cell), kRow, 1, 1, 0, true, true));
  file.setFrameBuffer(buffer);
  file.writeTile(column, row);
}

void write_part(Imf::MultiPartOutputFile& file, int number, const Part& part, const raster::OnProgress& progress) {
  Imf::TiledOutputPart out(file, number);
  const raster::VirtualRaster& whole = part.map->whole;
  const raster::Window all = part.map->window_of(part.map->cells);
  for (int row = 0; row < out.numYTiles(); ++row) {
    for (int column = 0; column < out.numXTiles(); ++column) {
      const int x = column * kTileCells, y = row * kTileCells;
      const raster::Window window{all.column + x, all.row + y, std::min(kTileCells, all.width - x),
                                  std::min(kTileCells, all.height - y)};
      if (part.type == Imf::HALF)
        write_tile(out, part, column, row, tile_of<LinearColor>(whole.colors(window), linear_color));
      else if (part.type == Imf::UINT)
        write_tile(out, part, column, row, tile_of<unsigned>(whole.classes(window), [](unsigned c) { return c; }));
      else
        write_tile(out, part, column, row, tile_of<float>(whole.floats(window), [](float z) { return z; }));
    }
    if (progress && !progress((row + 1.0) / out.numYTiles())) throw raster::Stopped{};
  }
}

}  // namespace

MapParts map_parts(const tiles::TileStore& store, MapRequest request, const std::filesystem::path& scratch) {
  const auto layer = [&](Layer chosen) {
    MapRequest one = request;
    one.layer = chosen;
    if (chosen == Layer::mask) one.resampling.reset();
    return map_raster(store, one, scratch);
  };
  return {layer(Layer::dsm), layer(Layer::confidence), layer(Layer::ortho), layer(Layer::mask)};
}

void write_exr_map(const MapParts& maps, const Destination& to, const raster::OnProgress& progress) {
  const std::vector<Part> parts = {{"height", &maps.height, Imf::FLOAT, {"height"}},
                                   {"sigma", &maps.sigma, Imf::FLOAT, {"sigma"}},
                                   {"colour", &maps.colour, Imf::HALF, {"R", "G", "B", "A"}},
                                   {"mask", &maps.mask, Imf::UINT, {"mask"}}};
  std::vector<Imf::Header> headers;
  std::transform(parts.begin(), parts.end(), std::back_inserter(headers), header_of);
  try {
    Imf::MultiPartOutputFile file(to.result().c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const raster::OnProgress of_part = [&](double share) {
        return !progress || progress((static_cast<double>(i) + share) / static_cast<double>(parts.size()));
      };
      write_part(file, static_cast<int>(i), parts[i], of_part);
    }
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw failure("cannot write " + to.path().string() + ": " + error.what());
  }
}

}  // namespace skysweep::exports
