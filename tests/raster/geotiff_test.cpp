// SPDX-License-Identifier: Apache-2.0
#include "raster/geotiff.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Labels height_labels() {
  return {.content = "surface height",
          .units = "metre",
          .vertical_reference = "EGM96 height",
          .software = "skysweep 0.1.0",
          .input_digest = "0123456789abcdef"};
}

Labels labels(const std::string& content) {
  Labels only_content;
  only_content.content = content;
  return only_content;
}

Raster<float> some_heights(int width, int height, const std::string& crs = local_metric_crs()) {
  Raster<float> raster{Array2d<float>(width, height),
                       {.crs_wkt = crs, .north_west_corner = {-51.2, 5000000.4}, .cell_m = 0.1},
                       height_labels()};
  Random random(7);
  for (float& value : raster.values) value = static_cast<float>(random.uniform(-400, 9000));
  raster.values(0, 0) = kNaN;
  raster.values(width - 1, height - 1) = kNaN;
  raster.values(1, 0) = -0.0f;
  raster.values(2, 0) = std::numeric_limits<float>::denorm_min();
  return raster;
}

// Equal bit for bit, NaN included.
bool same_bits(const Array2d<float>& a, const Array2d<float>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         !std::memcmp(a.data(), b.data(), a.size() * sizeof(float));
}

// All that a program prints on both streams.
std::string output_of(const std::string& command) {
  std::string output;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return output;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), n);
  ::pclose(pipe);
  return output;
}

TEST(GeoTiff, heights_come_back_bit_for_bit_with_labels_and_place) {
  const TempFolder folder;
  for (const auto& [width, height] : {std::pair{5, 3}, {256, 256}, {300, 513}}) {
    const Raster<float> written = some_heights(width, height);
    write_geotiff(folder / "dem.tif", written);
    const Raster<float> read = read_float_raster(folder / "dem.tif");
    EXPECT_TRUE(same_bits(read.values, written.values));
    EXPECT_EQ(read.georeference.north_west_corner, written.georeference.north_west_corner);
    EXPECT_EQ(read.georeference.cell_m, written.georeference.cell_m);
    EXPECT_EQ(read.labels.content, written.labels.content);
    EXPECT_EQ(read.labels.units, written.labels.units);
    EXPECT_EQ(read.labels.vertical_reference, written.labels.vertical_reference);
    EXPECT_EQ(read.labels.software, written.labels.software);
    EXPECT_EQ(read.labels.input_digest, written.labels.input_digest);
  }
  EXPECT_EQ(names_in(folder.path()).size(), 1u) << "side files were left behind";
}

TEST(GeoTiff, reference_systems_survive_the_file_as_the_same_text) {
  const TempFolder folder;
  for (const std::string& crs : {local_metric_crs(), crs_from_user_input("EPSG:32615"),
                                 crs_from_user_input("EPSG:2193"), crs_from_user_input("EPSG:32615+5773")}) {
    write_geotiff(folder / "dem.tif", some_heights(8, 8, crs));
    EXPECT_EQ(read_float_raster(folder / "dem.tif").georeference.crs_wkt, crs);
  }
}

TEST(GeoTiff, reference_system_without_a_code_survives_the_file) {
  const TempFolder folder;
  const std::string crs = crs_from_user_input("+proj=tmerc +lat_0=10 +lon_0=20 +k=0.99995 +ellps=GRS80 +units=m");
  write_geotiff(folder / "dem.tif", some_heights(8, 8, crs));
  EXPECT_TRUE(same_crs(read_float_raster(folder / "dem.tif").georeference.crs_wkt, crs));
}

TEST(GeoTiff, colours_and_classes_come_back) {
  const TempFolder folder;
  const GeoReference place = some_heights(4, 4).georeference;
  Raster<Rgba8> color{Array2d<Rgba8>(270, 19), place, labels("colour")};
  Raster<std::uint8_t> classes{Array2d<std::uint8_t>(270, 19), place, labels("source of the height")};
  Random random(11);
  for (std::size_t i = 0; i < color.values.size(); ++i) {
    const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
    color.values.data()[i] = {byte(), byte(), byte(), static_cast<std::uint8_t>(i % 3 ? 255 : 0)};
    classes.values.data()[i] = static_cast<std::uint8_t>(random.below(4));
  }
  write_geotiff(folder / "color.tif", color);
  write_geotiff(folder / "mask.tif", classes);
  EXPECT_EQ(read_color_raster(folder / "color.tif").values, color.values);
  EXPECT_EQ(read_class_raster(folder / "mask.tif").values, classes.values);
  EXPECT_EQ(read_class_raster(folder / "mask.tif").labels.content, "source of the height");
}

TEST(GeoTiff, same_values_give_the_same_bytes) {
  const TempFolder folder;
  write_geotiff(folder / "a.tif", some_heights(300, 300));
  write_geotiff(folder / "b.tif", some_heights(300, 300));
  EXPECT_EQ(file_bytes(folder / "a.tif"), file_bytes(folder / "b.tif"));
}

TEST(GeoTiff, other_programs_see_every_label) {
  if (output_of("gdalinfo --version").find("GDAL") == std::string::npos) GTEST_SKIP() << "gdalinfo is not installed";
  const TempFolder folder;
  write_geotiff(folder / "dem.tif", some_heights(300, 300, crs_from_user_input("EPSG:32615+5773")));
  const std::string info = output_of("gdalinfo " + (folder / "dem.tif").string());
  for (const char* label : {"EGM96 height", "NoData Value=nan", "Unit Type: metre", "Description = surface height",
                            "TIFFTAG_SOFTWARE=skysweep 0.1.0", "INPUT_DIGEST=0123456789abcdef",
                            "CONTENT=surface height", "UTM zone 15N", "COMPRESSION=DEFLATE", "AREA_OR_POINT=Area"})
    EXPECT_NE(info.find(label), std::string::npos) << label << " is missing in\n" << info;
  EXPECT_EQ(info.find("TIFFTAG_DATETIME"), std::string::npos);

  write_geotiff(folder / "color.tif", Raster<Rgba8>{Array2d<Rgba8>(9, 9), some_heights(4, 4).georeference, {}});
  const std::string color_info = output_of("gdalinfo " + (folder / "color.tif").string());
  EXPECT_NE(color_info.find("ColorInterp=Alpha"), std::string::npos) << color_info;
  EXPECT_NE(color_info.find("local metric frame (no CRS given)"), std::string::npos) << color_info;
}

TEST(GeoTiff, full_disk_is_an_error_that_names_the_file_and_keeps_the_old_one) {
  const TempFolder folder;
  write_geotiff(folder / "dem.tif", some_heights(8, 8));
  const std::string before = file_bytes(folder / "dem.tif");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_geotiff(folder / "dem.tif", some_heights(300, 300));
    } catch (const Error& error) {
      ::_exit(std::string(error.what()).find("dem.tif") != std::string::npos ? 0 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(file_bytes(folder / "dem.tif"), before);
  EXPECT_EQ(names_in(folder.path()).size(), 1u);
}

// A tile cut off at any length must be refused or, where only padding is lost, be read whole; never half.
TEST(GeoTiff, torn_file_is_refused_quietly_and_by_name) {
  const TempFolder folder;
  const Raster<float> whole = some_heights(512, 512);
  write_geotiff(folder / "dem.tif", whole);
  const std::string bytes = file_bytes(folder / "dem.tif");
  testing::internal::CaptureStderr();
  for (int part = 0; part < 32; ++part) {
    put_bytes(folder / "torn.tif", bytes.substr(0, bytes.size() * part / 32));
    const std::string message = message_of<Error>([&] { read_float_raster(folder / "torn.tif"); });
    EXPECT_NE(message.find("torn.tif"), std::string::npos) << message;
  }
  put_bytes(folder / "torn.tif", bytes.substr(0, bytes.size() - 1));
  EXPECT_THROW(read_float_raster(folder / "torn.tif"), Error);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ReadRaster, missing_file_and_other_kinds_of_file_are_refused_by_name) {
  const TempFolder folder;
  put_bytes(folder / "text.tif", "this is no raster");
  EXPECT_NE(message_of<Error>([&] { read_float_raster(folder / "missing.tif"); }).find("missing.tif"),
            std::string::npos);
  EXPECT_NE(message_of<Error>([&] { read_float_raster(folder / "text.tif"); }).find("text.tif"), std::string::npos);
}

TEST(ReadRaster, wrong_kind_of_values_is_refused) {
  const TempFolder folder;
  write_geotiff(folder / "dem.tif", some_heights(8, 8));
  write_geotiff(folder / "color.tif", Raster<Rgba8>{Array2d<Rgba8>(9, 9), some_heights(4, 4).georeference, {}});
  EXPECT_THROW(read_color_raster(folder / "dem.tif"), Error);
  EXPECT_THROW(read_class_raster(folder / "dem.tif"), Error);
  EXPECT_THROW(read_float_raster(folder / "color.tif"), Error);
  EXPECT_THROW(read_class_raster(folder / "color.tif"), Error);
}

// Esri ASCII grids are rasters that a test can write by hand.
void put_ascii_grid(const fs::path& path, const std::string& cell_size) {
  put_bytes(path,
            "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 20\n" + cell_size + "NODATA_value -9999\n1.5 -9999\n3 4\n");
}

TEST(ReadRaster, other_formats_are_read_with_their_no_data_as_nan) {
  const TempFolder folder;
  put_ascii_grid(folder / "dem.asc", "cellsize 0.5\n");
  const Raster<float> dem = read_float_raster(folder / "dem.asc");
  EXPECT_EQ(dem.values(0, 0), 1.5f);
  EXPECT_TRUE(std::isnan(dem.values(1, 0)));
  EXPECT_EQ(dem.values(1, 1), 4.0f);
  EXPECT_EQ(dem.extent(), (Box2d{{10, 20}, {11, 21}}));
  EXPECT_EQ(dem.georeference.crs_wkt, local_metric_crs());
  EXPECT_EQ(dem.georeference.cell_center(0, 0), (Vec2d{10.25, 20.75}));
}

TEST(ReadRaster, cells_that_are_not_square_are_refused) {
  const TempFolder folder;
  put_ascii_grid(folder / "dem.asc", "dx 0.5\ndy 0.25\n");
  EXPECT_NE(message_of<Error>([&] { read_float_raster(folder / "dem.asc"); }).find("square"), std::string::npos);
}

// A grey image (PGM) with a world file: the transform is free to be wrong.
void put_grey_image(const fs::path& stem, const std::string& world) {
  put_bytes(stem.string() + ".pgm", std::string("P5\n2 1\n255\n") + '\x10' + '\xff');
  if (!world.empty()) put_bytes(stem.string() + ".wld", world);
}

TEST(ReadRaster, grey_images_become_opaque_colours) {
  const TempFolder folder;
  put_grey_image(folder / "grey", "1\n0\n0\n-1\n100.5\n199.5\n");
  const Raster<Rgba8> grey = read_color_raster(folder / "grey.pgm");
  EXPECT_EQ(grey.values(0, 0), (Rgba8{16, 16, 16, 255}));
  EXPECT_EQ(grey.georeference.north_west_corner, (Vec2d{100, 200}));
}

TEST(ReadRaster, rotated_or_unplaced_images_are_refused) {
  const TempFolder folder;
  put_grey_image(folder / "rotated", "0.8\n0.6\n0.6\n-0.8\n100\n200\n");
  put_grey_image(folder / "flipped", "1\n0\n0\n1\n100\n200\n");
  put_grey_image(folder / "unplaced", "");
  EXPECT_NE(message_of<Error>([&] { read_color_raster(folder / "rotated.pgm"); }).find("rotated"), std::string::npos);
  EXPECT_NE(message_of<Error>([&] { read_color_raster(folder / "flipped.pgm"); }).find("mirrored"), std::string::npos);
  EXPECT_NE(message_of<Error>([&] { read_color_raster(folder / "unplaced.pgm"); }).find("georeference"),
            std::string::npos);
}

}  // namespace
}  // namespace skysweep::raster
