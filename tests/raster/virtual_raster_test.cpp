// SPDX-License-Identifier: Apache-2.0
#include "raster/virtual_raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

using namespace testing_support;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kCells = 600;  // more than a block of GDAL's
constexpr double kCellM = 0.5;

class Virtual : public testing::Test {
 protected:
  // Heights by place, with a hole, as a mosaic of one file.
  template <typename Height>
  VirtualRaster heights(Height height, const std::string& crs) {
    Raster<float> file{Array2d<float>(kCells, kCells), {crs, {691200, 5334000}, kCellM}, {}};
    for (int row = 0; row < kCells; ++row)
      for (int column = 0; column < kCells; ++column)
        file.values(column, row) = static_cast<float>(height(file.georeference.cell_center(column, row)));
    for (int row = 100; row < 120; ++row)
      for (int column = 200; column < 240; ++column) file.values(column, row) = kNaN;
    write_geotiff(folder / "heights.tif", file);
    stored = file.values;
    return VirtualRaster::mosaic(
        {CogKind::values, kCells, kCells, file.georeference, {}, {{folder / "heights.tif", 0, 0, kCells, kCells}}});
  }

  static double plane(Vec2d p) { return 500 + 0.1 * (p.x - 691200) - 0.2 * (p.y - 5334000); }

  TempFolder folder;
  Array2d<float> stored;
};

bool same_bits(const Array2d<float>& a, const Array2d<float>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(Virtual, a_window_of_a_mosaic_is_the_files_cells) {
  const VirtualRaster map = heights(plane, local_metric_crs());
  EXPECT_TRUE(same_bits(map.floats({190, 90, 100, 80}), crop(stored, 190, 90, 100, 80)));
  EXPECT_TRUE(same_bits(map.window({190, 90, 100, 80}).floats({10, 10, 50, 50}), crop(stored, 200, 100, 50, 50)));
}

// Also in a local frame, which no library can transform.
TEST_F(Virtual, the_same_lattice_gives_the_same_values_by_every_method) {
  for (const std::string& crs : {local_metric_crs(), crs_from_user_input("EPSG:32632")}) {
    const VirtualRaster map = heights(plane, crs);
    for (const Resampling method :
         {Resampling::nearest, Resampling::bilinear, Resampling::cubic, Resampling::average}) {
      const GeoReference shifted{crs, {691200 - 10 * kCellM, 5334000 + 20 * kCellM}, kCellM};
      const Array2d<float> cells = map.resampled({shifted, 700, 700, method, 1}).floats({10, 20, kCells, kCells});
      int differences = 0;
      for (int row = 0; row < kCells; ++row)
        for (int column = 0; column < kCells; ++column) {
          const float a = cells(column, row), b = stored(column, row);
          differences += std::isnan(a) != std::isnan(b) || std::abs(a - b) > 1e-4f;
        }
      EXPECT_EQ(differences, 0) << static_cast<int>(method);
    }
  }
}

TEST_F(Virtual, a_plane_stays_a_plane_in_another_system) {
  const std::string from = crs_from_user_input("EPSG:32632"), to = output_crs_from_user_input("EPSG:3857", from);
  const VirtualRaster map = heights(plane, from);
  const Box2d there = transformed_extent(from, to, {{691220, 5333800}, {691400, 5333980}});
  const double cell = 0.7;
  const GeoReference place{to, {there.min.x, there.max.y}, cell};
  const int width = static_cast<int>(there.width() / cell), height = static_cast<int>(there.height() / cell);
  const Array2d<float> cells =
      map.resampled({place, width, height, Resampling::bilinear, 1}).floats({0, 0, width, height});
  double largest = 0;
  int known = 0;
  const Box2d around_hole{{691200 + 199 * kCellM, 5334000 - 121 * kCellM},
                          {691200 + 241 * kCellM, 5334000 - 99 * kCellM}};
  for (int row = 3; row < height; row += 29)
    for (int column = 5; column < width; column += 29) {
      const Vec2d p = place.cell_center(column, row);
      const Box2d back = transformed_extent(to, from, {p, p});
      if (around_hole.contains(back.min)) continue;
      largest = std::max(largest, std::abs(plane(back.min) - cells(column, row)));
      ++known;
    }
  EXPECT_GT(known, 100);
  EXPECT_LT(largest, 2e-3);  // a hundredth of a cell on this slope, and the rounding of floats
}

TEST_F(Virtual, overlapping_windows_agree_bit_for_bit_after_resampling) {
  const std::string from = crs_from_user_input("EPSG:32632"), to = crs_from_user_input("EPSG:25833");
  const VirtualRaster map = heights([](Vec2d p) { return std::sin(p.x) + std::cos(p.y); }, from);
  const Box2d there = transformed_extent(from, to, {{691200, 5333700}, {691500, 5334000}});
  const GeoReference place{to, {std::floor(there.min.x), std::ceil(there.max.y)}, 0.3};
  const VirtualRaster other = map.resampled({place, 1024, 1024, Resampling::cubic, 1});
  const VirtualRaster again = map.resampled({place, 1024, 1024, Resampling::cubic, 1});
  const Array2d<float> all = other.floats({0, 0, 1024, 1024});
  EXPECT_TRUE(same_bits(again.floats({301, 417, 300, 200}), crop(all, 301, 417, 300, 200)));
  EXPECT_TRUE(same_bits(again.window({511, 100, 300, 300}).floats({0, 0, 300, 300}), crop(all, 511, 100, 300, 300)));
}

TEST_F(Virtual, the_mean_of_coarser_cells_leaves_no_data_out) {
  const std::string crs = local_metric_crs();
  const VirtualRaster map = heights([](Vec2d) { return 7; }, crs);
  const GeoReference coarse{crs, {691200, 5334000}, 4 * kCellM};
  for (const Resampling method : {Resampling::average, Resampling::bilinear}) {
    const Array2d<float> cells = map.resampled({coarse, 150, 150, method, 0.25}).floats({0, 0, 150, 150});
    for (const float z : cells) EXPECT_TRUE(std::isnan(z) || z == 7.0f) << z;
    EXPECT_TRUE(std::isnan(cells(55, 27)));  // inside the hole
    EXPECT_EQ(cells(70, 27), 7.0f);
  }
}

TEST_F(Virtual, no_data_can_be_another_number) {
  const VirtualRaster map = heights(plane, local_metric_crs()).with_no_data(-9999);
  EXPECT_EQ(map.floats({210, 110, 1, 1})(0, 0), -9999.0f);
  EXPECT_EQ(map.floats({0, 0, 1, 1})(0, 0), stored(0, 0));
}

TEST_F(Virtual, a_broken_source_is_named_and_stopping_leaves_nothing) {
  const VirtualRaster map = heights(plane, local_metric_crs());
  EXPECT_THROW(write_cog(folder / "map.tif", map, {}, [](double) { return false; }), Stopped);
  EXPECT_EQ(names_in(folder.path()).size(), 1u);
  put_bytes(folder / "heights.tif", "no raster");
  const std::string message = message_of<Error>([&] { map.floats({0, 0, 10, 10}); });
  EXPECT_NE(message.find("heights.tif"), std::string::npos) << message;
}

TEST(OutputCrs, takes_degrees_and_keeps_the_maps_heights) {
  const std::string map = crs_from_user_input("EPSG:32632+5773");
  EXPECT_EQ(vertical_reference(output_crs_from_user_input("EPSG:4326", map)), "EGM96 height");
  EXPECT_EQ(vertical_reference(output_crs_from_user_input("EPSG:4326", crs_from_user_input("EPSG:32632"))),
            "unknown: as in the photographs' poses");
  for (const char* wrong : {"EPSG:25832+7837", "EPSG:4979", "EPSG:5773", "nowhere", ""})
    EXPECT_THROW(output_crs_from_user_input(wrong, map), Error) << wrong;
}

TEST(TransformedExtent, local_frames_have_no_place_on_earth) {
  EXPECT_TRUE(is_local_crs(local_metric_crs()));
  EXPECT_FALSE(is_local_crs(crs_from_user_input("EPSG:32632")));
  EXPECT_THROW(transformed_extent(local_metric_crs(), crs_from_user_input("EPSG:3857"), {{0, 0}, {1, 1}}), Error);
}

}  // namespace
}  // namespace skysweep::raster
