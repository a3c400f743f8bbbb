// SPDX-License-Identifier: Apache-2.0
// Tiles are read back with GDAL's programs and sqlite3, and compared with what gdalwarp makes of the same map.
#include "export/web_tiles.h"

#include <cstring>
#include <map>

#include "core/error.h"
#include "export/raster_files.h"
#include "export/sample_map.h"
#include "export/tile_sets.h"

namespace skysweep::exports {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

constexpr ZoomRange kZooms{16, 19};  // pixels of 0.2 m on the ground: several tiles of the sample map

class WebTiles : public SampleMap {
 protected:
  MapRaster map(Layer layer, std::optional<Box2d> area = {}) {
    fs::create_directories(folder / "scratch");
    return map_raster(store, {.layer = layer, .area = area, .crs_wkt = web_crs(), .cell = web_cell(kZooms.max)},
                      folder / "scratch");
  }
  WebTileSummary tiles(Layer layer, TileEncoding encoding, const std::string& name, TileScheme scheme = TileScheme::xyz,
                       std::optional<Box2d> area = {}, int quality = 85) {
    Destination to(folder / name, DestinationKind::folder, false);
    const WebTileSummary summary = write_tile_folder(map(layer, area), {kZooms, encoding, quality}, scheme, to);
    to.publish();
    return summary;
  }
  // Files of a zoom by x and y.
  std::map<std::pair<int, int>, fs::path> tiles_of(const std::string& name, int zoom) const {
    std::map<std::pair<int, int>, fs::path> found;
    for (const auto& column : fs::directory_iterator(folder / name / std::to_string(zoom)))
      for (const auto& file : fs::directory_iterator(column.path()))
        found[{std::stoi(column.path().filename()), std::stoi(file.path().stem())}] = file.path();
    return found;
  }
};

bool same_bits(const Array2d<float>& a, const Array2d<float>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

// Of a tile's image, without georeference: through GDAL into a format that our readers take.
Array2d<Rgba8> picture(const fs::path& file) {
  const fs::path tiff = file.string() + ".read.tif";
  const ProgramResult result =
      run("gdal_translate -q -a_ullr 0 1 1 0 -co ALPHA=NON-PREMULTIPLIED " + file.string() + " " + tiff.string());
  EXPECT_EQ(result.status, 0) << result.output;
  Array2d<Rgba8> cells = raster::read_color_raster(tiff).values;
  fs::remove(tiff);
  return cells;
}

TEST(TileEncoding, heights_are_packed_as_the_formats_say) {
  const Array2d<float> heights(1, 1, 0.0f), none(1, 1, std::nanf("")), high(1, 1, 8848.86f), deep(1, 1, -20000.0f);
  const auto terrarium = [](const auto& h) { return packed_heights(h, TileEncoding::terrarium)(0, 0); };
  const auto terrain_rgb = [](const auto& h) { return packed_heights(h, TileEncoding::terrain_rgb)(0, 0); };
  EXPECT_EQ(terrarium(heights), (Rgba8{128, 0, 0, 255}));
  EXPECT_EQ(terrain_rgb(heights), (Rgba8{1, 134, 160, 255}));
  EXPECT_EQ(terrarium(none), (Rgba8{0, 0, 0, 0}));
  const Rgba8 a = terrarium(high), b = terrain_rgb(high);
  EXPECT_NEAR(a.r * 256 + a.g + a.b / 256.0 - 32768, 8848.86, 1 / 512.0 + 1e-3);
  EXPECT_NEAR((b.r * 65536 + b.g * 256 + b.b) / 10.0 - 10000, 8848.86, 0.051);
  EXPECT_EQ(terrain_rgb(deep), (Rgba8{0, 0, 0, 255}));
}

TEST(TileEncoding, coarser_tiles_leave_no_data_out) {
  Array2d<float> heights(2, 2, 10.0f);
  heights(1, 1) = std::nanf("");
  heights(0, 1) = 16;
  EXPECT_EQ(halved(heights)(0, 0), 12.0f);
  EXPECT_TRUE(std::isnan(halved(Array2d<float>(2, 2, std::nanf("")))(0, 0)));
  Array2d<Rgba8> colors(2, 2);
  colors(0, 0) = {200, 100, 50, 255};
  EXPECT_EQ(halved(colors)(0, 0), (Rgba8{200, 100, 50, 64}));
}

// Georeference and values against another program's way from the map to the tile.
TEST_F(WebTiles, tiles_are_what_gdalwarp_makes_of_the_map) {
  tiles(Layer::dsm, TileEncoding::float32, "web");
  Destination to(folder / "dsm.tif", DestinationKind::file, false);
  write_cog(map_raster(store, {}, folder.path()), to);
  to.publish();
  const auto files = tiles_of("web", kZooms.max);
  ASSERT_GE(files.size(), 4u);
  double largest = 0;
  int compared = 0;
  for (const auto& [xy, file] : files) {
    const double side = 2 * 20037508.342789244 / (1 << kZooms.max);  // as every description of XYZ tiles has it
    const double west = -20037508.342789244 + xy.first * side, north = 20037508.342789244 - xy.second * side;
    std::ostringstream command;
    command.precision(17);
    command << "gdalwarp -q -overwrite -novshift -s_srs EPSG:32632 -t_srs EPSG:3857 -et 0 -r bilinear -ts 256 256 -te "
            << west << " " << north - side << " " << west + side << " " << north << " " << (folder / "dsm.tif").string()
            << " " << (folder / "cut.tif").string();
    const ProgramResult warped = run(command.str());
    ASSERT_EQ(warped.status, 0) << warped.output;
    const auto expected = raster::read_float_raster(folder / "cut.tif"), tile = raster::read_float_raster(file);
    EXPECT_NEAR(tile.georeference.north_west_corner.x, west, 1e-6);
    EXPECT_NEAR(tile.georeference.north_west_corner.y, north, 1e-6);
    for (std::size_t i = 0; i < tile.values.size(); ++i) {
      const float a = tile.values.data()[i], b = expected.values.data()[i];
      if (std::isnan(a) || std::isnan(b)) continue;
      largest = std::max(largest, static_cast<double>(std::abs(a - b)));
      ++compared;
    }
  }
  EXPECT_GT(compared, 20000);
  EXPECT_LT(largest, 0.01);
}

// The seam test of web tiles.
TEST_F(WebTiles, neighbours_are_cut_from_one_raster_and_parents_made_of_children) {
  tiles(Layer::dsm, TileEncoding::float32, "web");
  const MapRaster whole = map(Layer::dsm);
  for (const auto& [xy, file] : tiles_of("web", kZooms.max)) {
    const std::int64_t half = std::int64_t{128} << kZooms.max;
    const std::int64_t west = 256ll * xy.first - half, north = half - 256ll * xy.second;
    EXPECT_TRUE(same_bits(raster::read_float_raster(file).values,
                          whole.whole.floats(whole.window_of({west, north - 256, west + 256, north}))));
  }
  for (int zoom = kZooms.min; zoom < kZooms.max; ++zoom) {
    const auto parents = tiles_of("web", zoom), children = tiles_of("web", zoom + 1);
    ASSERT_FALSE(parents.empty());
    for (const auto& [xy, file] : parents) {
      const Array2d<float> parent = raster::read_float_raster(file).values;
      for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
          const auto child = children.find({2 * xy.first + dx, 2 * xy.second + dy});
          const Array2d<float> expected = child == children.end()
                                              ? Array2d<float>(128, 128, std::nanf(""))
                                              : halved(raster::read_float_raster(child->second).values);
          const Array2d<float> quarter = crop(parent, 128 * dx, 128 * dy, 128, 128);
          for (std::size_t i = 0; i < quarter.size(); ++i) {
            const float a = quarter.data()[i], b = expected.data()[i];
            ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
          }
        }
    }
  }
}

TEST_F(WebTiles, packed_heights_are_the_floats_within_their_steps) {
  tiles(Layer::dsm, TileEncoding::float32, "floats");
  for (const auto& [encoding, step] :
       {std::pair{TileEncoding::terrarium, 1 / 256.0}, {TileEncoding::terrain_rgb, 0.1}}) {
    const std::string name = encoding_names()[static_cast<std::size_t>(encoding)];
    tiles(Layer::dsm, encoding, name);
    for (const int zoom : {kZooms.min, kZooms.max}) {
      const auto packed = tiles_of(name, zoom), floats = tiles_of("floats", zoom);
      ASSERT_EQ(packed.size(), floats.size());
      for (const auto& [xy, file] : packed) {
        const Array2d<Rgba8> cells = picture(file);
        const Array2d<float> heights = raster::read_float_raster(floats.at(xy)).values;
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const Rgba8 c = cells.data()[i];
          ASSERT_EQ(c.a, std::isnan(heights.data()[i]) ? 0 : 255);
          if (c.a == 0) continue;
          const double height = encoding == TileEncoding::terrarium ? c.r * 256 + c.g + c.b / 256.0 - 32768
                                                                    : (c.r * 65536 + c.g * 256 + c.b) / 10.0 - 10000;
          ASSERT_NEAR(height, heights.data()[i], step / 2 + 1e-4);
        }
      }
    }
  }
}

TEST_F(WebTiles, pictures_show_the_colours_and_keep_no_data) {
  const MapRaster whole = map(Layer::ortho);
  struct Case {
    const char* name;
    TileEncoding encoding;
    int quality;
    double mean_error;  // grey levels
  };
  for (const Case& c : {Case{"png", TileEncoding::png, 85, 0}, Case{"webp", TileEncoding::webp, 90, 6},
                        Case{"lossless", TileEncoding::webp, 100, 0}, Case{"jpeg", TileEncoding::jpeg, 95, 6}}) {
    const WebTileSummary summary = tiles(Layer::ortho, c.encoding, c.name, TileScheme::xyz, {}, c.quality);
    EXPECT_EQ(summary.lost_no_data, c.encoding == TileEncoding::jpeg);
    double sum = 0;
    int known = 0, wrong_alpha = 0;
    for (const auto& [xy, file] : tiles_of(c.name, kZooms.max)) {
      const std::int64_t half = std::int64_t{128} << kZooms.max;
      const std::int64_t west = 256ll * xy.first - half, north = half - 256ll * xy.second;
      const Array2d<Rgba8> expected = whole.whole.colors(whole.window_of({west, north - 256, west + 256, north}));
      const Array2d<Rgba8> cells = picture(file);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const Rgba8 a = cells.data()[i], b = expected.data()[i];
        wrong_alpha += c.encoding == TileEncoding::jpeg ? b.a == 0 && a.g < 200 && a.r < 200 : a.a != b.a;
        if (b.a < 255) continue;
        sum += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
        ++known;
      }
    }
    EXPECT_GT(known, 20000);
    EXPECT_LE(sum / (3.0 * known), c.mean_error) << c.name;
    EXPECT_LE(wrong_alpha, c.encoding == TileEncoding::jpeg ? 2000 : 0) << c.name;  // ringing of JPEG beside the map
  }
}

TEST_F(WebTiles, a_lower_quality_gives_smaller_files) {
  const auto bytes_of = [&](const std::string& name) {
    std::uintmax_t sum = 0;
    for (const auto& [xy, file] : tiles_of(name, kZooms.max)) sum += fs::file_size(file);
    return sum;
  };
  for (const TileEncoding encoding : {TileEncoding::webp, TileEncoding::jpeg}) {
    const std::string name = extension_of(encoding);
    tiles(Layer::hillshade, encoding, name + "30", TileScheme::xyz, {}, 30);
    tiles(Layer::hillshade, encoding, name + "90", TileScheme::xyz, {}, 90);
    EXPECT_LT(bytes_of(name + "30"), bytes_of(name + "90"));
  }
}

TEST_F(WebTiles, tms_rows_count_from_the_south) {
  tiles(Layer::relief, TileEncoding::png, "xyz");
  tiles(Layer::relief, TileEncoding::png, "tms", TileScheme::tms);
  const auto xyz = tiles_of("xyz", kZooms.max), tms = tiles_of("tms", kZooms.max);
  ASSERT_EQ(xyz.size(), tms.size());
  for (const auto& [xy, file] : xyz)
    EXPECT_EQ(file_bytes(file), file_bytes(tms.at({xy.first, (1 << kZooms.max) - 1 - xy.second})));
  EXPECT_NE(file_bytes(folder / "tms/tilejson.json").find("\"scheme\": \"tms\""), std::string::npos);
}

TEST_F(WebTiles, the_folder_says_what_it_holds) {
  const WebTileSummary summary = tiles(Layer::dsm, TileEncoding::terrarium, "web");
  std::size_t files = 0;
  for (int zoom = kZooms.min; zoom <= kZooms.max; ++zoom) files += tiles_of("web", zoom).size();
  EXPECT_EQ(files, static_cast<std::size_t>(summary.tiles));
  const std::string labels = file_bytes(folder / "web" / kLabelsFile), json = file_bytes(folder / "web/tilejson.json");
  for (const char* word :
       {"EGM96 height", "alpha 0", "metre", "skysweep test", "INPUT_DIGEST", "EPSG:3857", "Terrarium"})
    EXPECT_NE(labels.find(word), std::string::npos) << word << " is not in\n" << labels;
  for (const char* word : {"\"encoding\": \"terrarium\"", "\"minzoom\": 16", "\"maxzoom\": 19", "{z}/{x}/{y}.png"})
    EXPECT_NE(json.find(word), std::string::npos) << word << " is not in\n" << json;
}

TEST_F(WebTiles, an_area_takes_the_tiles_that_show_it) {
  tiles(Layer::dsm, TileEncoding::float32, "all");
  const Box2d corner{{kCorner.x + 1, kCorner.y + 1}, {kCorner.x + 4, kCorner.y + 4}};
  tiles(Layer::dsm, TileEncoding::float32, "part", TileScheme::xyz, corner);
  const auto all = tiles_of("all", kZooms.max), part = tiles_of("part", kZooms.max);
  EXPECT_LT(part.size(), all.size());
  ASSERT_FALSE(part.empty());
  for (const auto& [xy, file] : part)
    EXPECT_TRUE(same_bits(raster::read_float_raster(file).values, raster::read_float_raster(all.at(xy)).values));
}

TEST_F(WebTiles, usual_zooms_go_from_one_tile_to_the_maps_cells) {
  const ZoomRange zooms = usual_zooms(store, {});
  const double ground = web_cell(zooms.max) * std::cos(48.1 * 3.14159265358979 / 180);
  EXPECT_LE(ground, 1.1 * kCellM);
  EXPECT_GT(2 * ground, 1.1 * kCellM);
  EXPECT_EQ(zooms.min, 18);  // 96 m are 144 units of Mercator; a tile of zoom 18 has 153, of zoom 19 half of it
}

TEST_F(WebTiles, mbtiles_hold_the_same_tiles_and_every_label) {
  tiles(Layer::ortho, TileEncoding::png, "web");
  const fs::path file = folder / "map.mbtiles";
  Destination to(file, DestinationKind::file, false);
  const WebTileSummary summary = write_mbtiles(map(Layer::ortho), {kZooms, TileEncoding::png, 85}, to);
  to.publish();
  const auto query = [&](const std::string& sql) {
    return run("sqlite3 " + file.string() + " \"" + sql + "\"").output;
  };
  EXPECT_EQ(query("PRAGMA integrity_check"), "ok\n");
  EXPECT_EQ(query("SELECT count(*) FROM tiles"), std::to_string(summary.tiles) + "\n");
  const std::string words = query("SELECT name, value FROM metadata");
  for (const char* word : {"format|png", "minzoom|16", "maxzoom|19", "NO_DATA|alpha 0", "SOFTWARE|skysweep test",
                           "INPUT_DIGEST|", "CRS|WGS 84 / Pseudo-Mercator", "CONTENT|colour (sRGB)", "bounds|11."})
    EXPECT_NE(words.find(word), std::string::npos) << word << " is not in\n" << words;
  for (const auto& [xy, path] : tiles_of("web", kZooms.max)) {
    const std::string where = " FROM tiles WHERE zoom_level = 19 AND tile_column = " + std::to_string(xy.first) +
                              " AND tile_row = " + std::to_string((1 << 19) - 1 - xy.second);
    query("SELECT writefile('" + (folder / "one.png").string() + "', tile_data)" + where);
    EXPECT_EQ(file_bytes(folder / "one.png"), file_bytes(path));
  }
  // A colour at a place, through GDAL's driver.
  const Vec2d p{30.25, 33.25};
  const std::vector<double> color = values_at(file, {{kCorner.x + p.x, kCorner.y + p.y}}, "-l_srs EPSG:32632");
  ASSERT_EQ(color.size(), 4u);
  EXPECT_NEAR(color[0], SampleMap::color(p).r, 8);
  EXPECT_NEAR(color[1], SampleMap::color(p).g, 8);
  EXPECT_EQ(color[3], 255);
}

TEST_F(WebTiles, mbtiles_hold_no_floats) {
  Destination to(folder / "map.mbtiles", DestinationKind::file, false);
  const std::string message = message_of<Error>([&] {
    write_mbtiles(map(Layer::dsm), {kZooms, TileEncoding::float32, 85}, to);
  });
  EXPECT_NE(message.find("terrarium"), std::string::npos) << message;
}

TEST_F(WebTiles, stopping_leaves_nothing) {
  {
    Destination to(folder / "map.mbtiles", DestinationKind::file, false);
    EXPECT_THROW(write_mbtiles(map(Layer::ortho), {kZooms, TileEncoding::png, 85}, to, [](double) { return false; }),
                 raster::Stopped);
  }
  EXPECT_FALSE(fs::exists(folder / "map.mbtiles"));
}

}  // namespace
}  // namespace skysweep::exports
