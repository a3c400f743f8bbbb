// SPDX-License-Identifier: Apache-2.0
// Every format is read back with GDAL's own programs.
#include "export/raster_files.h"

#include <cstring>

#include "core/error.h"
#include "export/mosaic.h"
#include "export/sample_map.h"

namespace skysweep::exports {
namespace {

using namespace testing_support;
using raster::Resampling;

constexpr auto kFile = DestinationKind::file;
constexpr auto kFolder = DestinationKind::folder;

class RasterFiles : public SampleMap {
 protected:
  MapRaster map(const MapRequest& request = {}) { return map_raster(store, request, scratch()); }
  std::filesystem::path scratch() const {
    std::filesystem::create_directories(folder / "scratch");
    return folder / "scratch";
  }
  std::filesystem::path cog(const MapRequest& request, const std::string& name) {
    Destination to(folder / name, kFile, false);
    write_cog(map(request), to);
    to.publish();
    return folder / name;
  }
  static Vec2d world(Vec2d p) { return {kCorner.x + p.x, kCorner.y + p.y}; }
  // Heights of a file by place.
  static void expect_heights(const std::filesystem::path& file, double tolerance,
                             const std::string& options = "-geoloc") {
    const std::vector<Vec2d> places = {{3.25, 4.75}, {31.75, 20.25}, {32.25, 20.25}, {60.25, 31.75}, {20.25, 60.25}};
    std::vector<Vec2d> there;
    for (const Vec2d p : places) there.push_back(world(p));
    const std::vector<double> values = values_at(file, there, options);
    ASSERT_EQ(values.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(values[i], height(places[i]), tolerance) << i;
  }
};

bool same_bits(const Array2d<float>& a, const Array2d<float>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(RasterFiles, the_maps_own_cells_are_exported_bit_for_bit) {
  write_mosaic(store, "dem", known_extent(store), folder / "mosaic.tif");
  const auto mosaic = raster::read_float_raster(folder / "mosaic.tif");
  const auto exported = raster::read_float_raster(cog({}, "dsm.tif"));
  EXPECT_TRUE(same_bits(exported.values, mosaic.values));
  EXPECT_EQ(exported.georeference.north_west_corner, mosaic.georeference.north_west_corner);
  expect_heights(folder / "dsm.tif", 1e-4);
  EXPECT_TRUE(std::isnan(values_at(folder / "dsm.tif", {world({43.25, 12.25})}, "-geoloc")[0])) << "the hole";
}

TEST_F(RasterFiles, every_layer_is_labelled) {
  for (const std::string& name : layer_names()) {
    const auto layer = static_cast<Layer>(&name - layer_names().data());
    const raster::Labels labels = raster::read_labels(cog({.layer = layer}, name + ".tif"));
    EXPECT_FALSE(labels.content.empty()) << name;
    EXPECT_EQ(labels.units, layer == Layer::dsm || layer == Layer::confidence ? "metre" : "") << name;
    EXPECT_EQ(labels.vertical_reference, layer == Layer::dsm || layer == Layer::relief ? "EGM96 height" : "") << name;
    EXPECT_EQ(labels.software, "skysweep test");
    EXPECT_EQ(labels.input_digest.size(), 32u);
  }
  const std::string info = run("gdalinfo " + (folder / "dsm.tif").string()).output;
  for (const char* word : {"LAYOUT=COG", "UTM zone 32N", "EGM96 height", "NoData Value=nan", "Unit Type: metre"})
    EXPECT_NE(info.find(word), std::string::npos) << word << " is not in\n" << info;
}

TEST_F(RasterFiles, another_crs_shows_the_same_heights_at_the_same_places) {
  const std::string map_crs = store.crs_wkt();
  for (const char* crs : {"EPSG:4326", "EPSG:3857", "EPSG:25833"}) {
    const std::string name = std::string("dsm-") + (crs + 5) + ".tif";
    cog({.crs_wkt = raster::output_crs_from_user_input(crs, map_crs)}, name);
    // gdallocationinfo transforms from the map's CRS by itself
    expect_heights(folder / name, 0.15, "-l_srs EPSG:32632");
    const std::string info = run("gdalinfo " + (folder / name).string()).output;
    EXPECT_NE(info.find("VERTICAL_REFERENCE=EGM96 height"), std::string::npos) << info;
    EXPECT_TRUE(std::isnan(values_at(folder / name, {world({43.25, 12.25})}, "-l_srs EPSG:32632")[0])) << "the hole";
  }
}

TEST_F(RasterFiles, resampling_methods_differ_and_coarse_cells_are_means) {
  std::vector<std::string> bytes;
  for (const Resampling method : {Resampling::nearest, Resampling::bilinear, Resampling::cubic, Resampling::average}) {
    const std::string name = "m" + std::to_string(static_cast<int>(method)) + ".tif";
    bytes.push_back(file_bytes(cog({.cell = 0.7, .resampling = method}, name)));
    expect_heights(folder / name, 0.3);
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i) EXPECT_NE(bytes[i], bytes.back());
  }
  // Four cells of the map in one: their mean, which the map's level 1 holds.
  const auto coarse = raster::read_float_raster(cog({.cell = 1.0}, "coarse.tif"));
  const auto fine = raster::read_float_raster(cog({}, "fine.tif"));
  for (int i = 0; i < 20; ++i) {
    const double mean = (fine.values(2 * i, 2 * i) + fine.values(2 * i + 1, 2 * i) + fine.values(2 * i, 2 * i + 1) +
                         fine.values(2 * i + 1, 2 * i + 1)) /
                        4.0;
    if (std::isnan(coarse.values(i, i))) continue;
    EXPECT_NEAR(coarse.values(i, i), mean, 1e-4);
  }
}

TEST_F(RasterFiles, a_window_holds_the_cells_whose_centres_lie_in_it) {
  const Vec2d a = world({10, 12}), b = world({20, 15.3});
  const auto part = raster::read_float_raster(cog({.area = Box2d{a, b}}, "part.tif"));
  EXPECT_EQ(part.values.width(), 20);
  EXPECT_EQ(part.values.height(), 7);  // centres 12.25 .. 15.25
  EXPECT_EQ(part.georeference.north_west_corner, (Vec2d{a.x, kCorner.y + 15.5}));
  EXPECT_THROW(map({.area = Box2d{{0, 0}, {1, 1}}}), Error);
}

// The seam test of rasters: what two exports both show, they show alike, on every lattice.
TEST_F(RasterFiles, overlapping_exports_agree_bit_for_bit) {
  const std::string mercator = raster::output_crs_from_user_input("EPSG:3857", store.crs_wkt());
  const std::vector<MapRequest> lattices = {{},
                                            {.cell = 0.3},
                                            {.cell = 1.7},
                                            {.cell = 2.0, .resampling = Resampling::average},
                                            {.crs_wkt = mercator, .cell = 0.75},
                                            {.layer = Layer::confidence, .crs_wkt = mercator}};
  int number = 0;
  for (MapRequest request : lattices) {
    const std::string name = "lattice" + std::to_string(number++);
    request.area = Box2d{world({0, 0}), world({60, 40})};
    const auto west = raster::read_float_raster(cog(request, name + "w.tif"));
    request.area = Box2d{world({35, 8}), world({96, 50})};
    const auto east = raster::read_float_raster(cog(request, name + "e.tif"));
    const double cell = west.georeference.cell_m;
    const Vec2d shift = east.georeference.north_west_corner - west.georeference.north_west_corner;
    const auto columns = static_cast<int>(std::lround(shift.x / cell)),
               rows = static_cast<int>(std::lround(-shift.y / cell));
    EXPECT_NEAR(columns * cell, shift.x, 1e-6);
    int compared = 0, differences = 0;
    for (int y = 0; y < east.values.height(); ++y)
      for (int x = 0; x < east.values.width(); ++x) {
        if (!west.values.contains(x + columns, y + rows)) continue;
        const float a = east.values(x, y), b = west.values(x + columns, y + rows);
        ++compared;
        differences += std::memcmp(&a, &b, sizeof a) != 0;
      }
    EXPECT_GT(compared, 200) << name;
    EXPECT_EQ(differences, 0) << name;
  }
}

// Shades near the border of a window depend on heights beyond it.
TEST_F(RasterFiles, shaded_windows_are_cut_from_one_picture) {
  for (const Layer layer : {Layer::hillshade, Layer::relief}) {
    const std::string name = to_string(layer);
    const auto all = raster::read_color_raster(cog({.layer = layer}, name + ".tif"));
    const auto part = raster::read_color_raster(
        cog({.layer = layer, .area = Box2d{world({20, 10}), world({50, 30})}}, name + "-part.tif"));
    const Vec2d shift = part.georeference.north_west_corner - all.georeference.north_west_corner;
    const int columns = static_cast<int>(std::lround(shift.x / kCellM)),
              rows = static_cast<int>(std::lround(-shift.y / kCellM));
    EXPECT_EQ(part.values, crop(all.values, columns, rows, part.values.width(), part.values.height()));
    EXPECT_EQ(all.values(0, 127).a, 255);
    EXPECT_EQ(all.values(86, 105).a, 0) << "the hole";
  }
}

TEST_F(RasterFiles, a_relief_takes_the_heights_for_its_colours) {
  const auto usual = file_bytes(cog({.layer = Layer::relief}, "usual.tif"));
  EXPECT_NE(usual,
            file_bytes(cog({.layer = Layer::relief, .relief_span_m = raster::HeightSpan{400, 600}}, "wide.tif")));
  EXPECT_NE(raster::read_labels(folder / "wide.tif").content.find("from 400.00 m"), std::string::npos);
}

// The seam test of tiles.
TEST_F(RasterFiles, tiles_show_their_neighbours_cells_where_they_overlap) {
  for (const MapRequest& request : {MapRequest{}, MapRequest{.cell = 0.6}}) {
    const std::string name = request.cell ? "coarse" : "own";
    Destination to(folder / name, kFolder, false);
    const int written = write_geotiff_tiles(map(request), {40, 3}, to);
    to.publish();
    const auto whole = raster::read_float_raster(cog(request, name + ".tif"));
    int tiles = 0, compared = 0, differences = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
      if (entry.path().extension() != ".tif") continue;
      ++tiles;
      const auto tile = raster::read_float_raster(entry.path());
      EXPECT_EQ(raster::read_labels(entry.path()).vertical_reference, "EGM96 height");
      const Vec2d shift = tile.georeference.north_west_corner - whole.georeference.north_west_corner;
      const int columns = static_cast<int>(std::lround(shift.x / whole.georeference.cell_m));
      const int rows = static_cast<int>(std::lround(-shift.y / whole.georeference.cell_m));
      for (int y = 0; y < tile.values.height(); ++y)
        for (int x = 0; x < tile.values.width(); ++x) {
          const float a = tile.values(x, y), b = whole.values(x + columns, y + rows);
          ++compared;
          differences += std::memcmp(&a, &b, sizeof a) != 0;
        }
    }
    EXPECT_EQ(tiles, written);
    EXPECT_GT(tiles, 8);
    EXPECT_EQ(differences, 0);
    EXPECT_GT(compared, static_cast<int>(whole.values.size()) * 6 / 10) << "tiles without heights are left out";
  }
  EXPECT_NE(file_bytes(folder / "own" / kLabelsFile).find("EGM96 height"), std::string::npos);
}

TEST_F(RasterFiles, a_tile_has_the_same_name_and_cells_in_every_window) {
  Destination all(folder / "all", kFolder, false);
  write_geotiff_tiles(map(), {32, 0}, all);
  all.publish();
  Destination part(folder / "part", kFolder, false);
  write_geotiff_tiles(map({.area = Box2d{world({16, 16}), world({64, 32})}}), {32, 0}, part);
  part.publish();
  int compared = 0;
  for (const std::string& name : names_in(folder / "part")) {
    if (name == kLabelsFile) continue;
    EXPECT_TRUE(same_bits(raster::read_float_raster(folder / "part" / name).values,
                          raster::read_float_raster(folder / "all" / name).values))
        << name;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

TEST_F(RasterFiles, ascii_grid_is_read_by_gdal) {
  for (const Layer layer : {Layer::dsm, Layer::mask}) {
    const std::string name = to_string(layer) + ".asc";
    Destination to(folder / name, kFile, false);
    write_ascii_grid(map({.layer = layer}), to);
    to.publish();
  }
  expect_heights(folder / "dsm.asc", 1e-4);
  EXPECT_EQ(values_at(folder / "dsm.asc", {world({43.25, 12.25})}, "-geoloc")[0], -9999);
  const std::vector<double> codes =
      values_at(folder / "mask.asc", {world({3, 3}), world({60, 3}), world({43.25, 12.25})}, "-geoloc");
  EXPECT_EQ(codes, (std::vector<double>{1, 2, 0}));
  const std::string info = run("gdalinfo " + (folder / "dsm.asc").string()).output;
  for (const char* word : {"UTM zone 32N", "NoData Value=-9999", "VERTICAL_REFERENCE=EGM96 height", "UNITS=metre",
                           "SOFTWARE=skysweep test", "INPUT_DIGEST=", "NO_DATA=-9999"})
    EXPECT_NE(info.find(word), std::string::npos) << word << " is not in\n" << info;
  EXPECT_NE(file_bytes(folder / "dsm.prj").find("WGS_1984_UTM_Zone_32N"), std::string::npos);
  EXPECT_NE(run("gdalinfo " + (folder / "mask.asc").string()).output.find("NoData Value=0"), std::string::npos);
}

TEST_F(RasterFiles, xyz_text_has_a_line_for_each_known_cell) {
  Destination to(folder / "dsm.xyz", kFile, false);
  const std::int64_t points = write_xyz_text(map({.area = Box2d{world({0, 0}), world({64, 64})}}), to);
  to.publish();
  const std::string text = file_bytes(folder / "dsm.xyz");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), points);
  EXPECT_EQ(points, 128 * 128 - 12 * 10);  // less the hole
  expect_heights(folder / "dsm.xyz", 1e-4);
  EXPECT_NE(run("gdalinfo " + (folder / "dsm.xyz").string()).output.find("VERTICAL_REFERENCE=EGM96"),
            std::string::npos);
}

TEST_F(RasterFiles, colours_are_no_numbers) {
  Destination to(folder / "x", kFile, false);
  const MapRaster ortho = map({.layer = Layer::ortho});
  for (const auto& write : {+[](const MapRaster&m, const Destination&d) { write_ascii_grid(m, d); },
                            +[](const MapRaster&m, const Destination&d) { write_xyz_text(m, d); }})
    EXPECT_NE(message_of<Error>([&] { write(ortho, to); }).find("--layer"), std::string::npos);
}

TEST_F(RasterFiles, requests_that_cannot_be_met_are_refused) {
  for (const MapRequest& wrong :
       {MapRequest{.cell = 0.0}, MapRequest{.cell = 1e-9}, MapRequest{.resampling = Resampling::cubic},
        MapRequest{.layer = Layer::mask, .cell = 2.0, .resampling = Resampling::average},
        MapRequest{.relief_span_m = raster::HeightSpan{1, 2}},
        MapRequest{.layer = Layer::relief, .relief_span_m = raster::HeightSpan{2, 1}}})
    EXPECT_THROW(map(wrong), Error);
}

// Memory must not grow with the map when its levels are missing.
TEST_F(RasterFiles, very_coarse_cells_need_the_maps_levels) {
  EXPECT_EQ(map({.cell = 8.0}).cells.width(), 12);
  std::filesystem::remove_all(folder / "tiles/dem/l1");
  const std::string message = message_of<Error>([&] { map({.cell = 8.0}); });
  EXPECT_NE(message.find("run the project again"), std::string::npos) << message;
  EXPECT_NO_THROW(map({.cell = 4.0}));
}

TEST_F(RasterFiles, the_digest_tells_what_the_export_was_made_of) {
  const auto digest = [&](const MapRequest& request) { return map(request).labels.input_digest; };
  const std::string own = digest({});
  EXPECT_EQ(own, digest({}));
  EXPECT_NE(own, digest({.layer = Layer::confidence}));
  EXPECT_NE(own, digest({.cell = 1.0}));
  EXPECT_NE(own, digest({.area = Box2d{world({0, 0}), world({10, 10})}}));
  store.write({0, kFirstX, kFirstY}, tile({0, kFirstX, kFirstY}), "other");
  EXPECT_NE(own, digest({}));
}

class LocalRasterFiles : public SampleMap {
 protected:
  LocalRasterFiles() : SampleMap("") {}
};

TEST_F(LocalRasterFiles, a_local_frame_can_be_resampled_and_is_named) {
  for (const auto& [name, request] : {std::pair{"own.tif", MapRequest{}}, {"coarse.tif", MapRequest{.cell = 0.8}}}) {
    Destination to(folder / name, kFile, false);
    write_cog(map_raster(store, request, folder.path()), to);
    to.publish();
    EXPECT_EQ(raster::read_float_raster(folder / name).georeference.crs_wkt, raster::local_metric_crs());
    EXPECT_EQ(raster::read_labels(folder / name).vertical_reference, "unknown: as in the photographs' poses");
  }
}

}  // namespace
}  // namespace skysweep::exports
