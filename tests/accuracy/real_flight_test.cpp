// SPDX-License-Identifier: Apache-2.0
// A part of a real flight over a park (18 photographs of 2 megapixels from 37 m), against the points that bundle
// adjustment found in the same photographs. SKYSWEEP_DATA names the folder that holds the flight.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "export/mosaic.h"
#include "formats/check_points.h"
#include "pipeline/session.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "report/height_accuracy.h"

namespace skysweep::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr double kGsdM = 0.032;
const Vec3d kOrigin{576700, 5188170, 0};
const Box2d kArea{{576690, 5188155}, {576715, 5188185}};

// Bounding box of two columns of a CSV file.
Box2d box_of_columns(const fs::path& csv, const std::string& x_name, const std::string& y_name) {
  std::ifstream file(csv);
  Box2d box;
  int x_column = -1, y_column = -1;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    if (x_column < 0) {
      for (int i = 0; i < static_cast<int>(fields.size()); ++i) {
        if (fields[i] == x_name) x_column = i;
        if (fields[i] == y_name) y_column = i;
      }
      if (x_column < 0 || y_column < 0) return box;
    } else {
      box.extend({std::stod(fields[x_column]), std::stod(fields[y_column])});
    }
  }
  return box;
}

std::vector<Vec3d> check_points_inside(const fs::path& model) {
  std::vector<Vec3d> points;
  for (const formats::CheckPoint& point : formats::read_check_points(model, {4, 1.0}, kOrigin))
    if (kArea.contains({point.position.x, point.position.y})) points.push_back(point.position);
  return points;
}

TEST(RealFlight, part_of_a_park_agrees_with_its_check_points_and_lies_where_gps_says) {
  const char* data = std::getenv("SKYSWEEP_DATA");
  if (!data) GTEST_SKIP() << "SKYSWEEP_DATA does not name a folder with real flights";
  const fs::path flight = fs::path(data) / "brighton_beach";
  if (!fs::exists(flight)) GTEST_SKIP() << flight.string() << " is not there";

  const testing_support::TempFolder folder;
  pipeline::RunRequest request;
  request.images = flight / "images";
  request.poses = flight / "sparse";
  request.project = folder / "project";
  request.crs = "EPSG:32615";
  request.origin = kOrigin;
  request.area = kArea;
  request.threads = 2;
  pipeline::Progress silence;
  const pipeline::RunSummary summary = pipeline::run(request, silence, false);
  const pipeline::ProjectPaths paths(request.project);
  exports::write_mosaic(pipeline::open_store(paths, summary.settings), "dem", kArea, paths.mosaic("dsm"));
  const raster::Raster<float> dsm = raster::read_float_raster(paths.mosaic("dsm"));

  const std::vector<Vec3d> points = check_points_inside(flight / "sparse");
  ASSERT_GT(points.size(), 100u);
  const report::HeightErrors errors = report::compare_points(dsm, points, {kGsdM}).overall;
  RecordProperty("points", std::to_string(points.size()));
  RecordProperty("valid_share", std::to_string(errors.valid_share()));
  RecordProperty("median_absolute_gsd", std::to_string(errors.median_absolute_m / kGsdM));
  RecordProperty("le90_gsd", std::to_string(errors.le90_m / kGsdM));
  EXPECT_GE(errors.valid_share(), 0.9);
  EXPECT_LE(errors.median_absolute_m, 2.5 * kGsdM);
  EXPECT_LE(errors.le90_m, 2 * kGsdM);

  EXPECT_TRUE(raster::same_crs(dsm.georeference.crs_wkt, raster::crs_from_user_input("EPSG:32615")));
  const Box2d flown = box_of_columns(flight / "poses.csv", "gps_easting", "gps_northing");
  const Box2d mapped = dsm.extent();
  ASSERT_FALSE(flown.empty());
  EXPECT_TRUE(flown.contains({0.5 * (mapped.min.x + mapped.max.x), 0.5 * (mapped.min.y + mapped.max.y)}));
}

}  // namespace
}  // namespace skysweep::accuracy
