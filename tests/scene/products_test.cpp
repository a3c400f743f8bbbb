// SPDX-License-Identifier: Apache-2.0
// What stands beside the photographs: everything is checked against camera, truth and the files as other programs read
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/error.h"
#include "formats/check_points.h"
#include "formats/gcp_list.h"
#include "formats/pose_set.h"
#include "raster/exr.h"
#include "raster/geotiff.h"
#include "raster/photo.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

// A town that twelve small photographs see, in UTM.
const char* const kScene = R"(
seed = 3
origin = [691000, 5334000, 500]
crs = "EPSG:32632"
area_m = [20, 16]
[terrain]
relief_m = 0.8
wavelength_m = 25
[town]
block_m = 12
street_m = 6
min_height_m = 2
max_height_m = 5
[camera]
width_px = 200
height_px = 150
focal_px = 200
distortion = [-0.1, 0.02, 0.0004, -0.0003, 0]
[flight]
gsd_m = 0.1
along_overlap = 0.6
across_overlap = 0.5
beyond_area_m = -4
tilt_sigma_deg = 2
position_sigma_m = 0.3
)";

class Products : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("products_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
  }
  // Simulates the scene above with more tables; gives back its folder.
  fs::path simulated(const std::string& more, const std::string& name = "a") {
    SerialExecutor executor;
    simulate(parse_scene(kScene + more, "s.toml"), folder_ / name, executor);
    return folder_ / name;
  }
  static std::vector<camera::Camera> cameras(const fs::path& folder) {
    std::vector<camera::Camera> out;
    for (const auto& image : formats::read_poses((folder / "poses.csv").string()).images)
      out.emplace_back(image.model, image.pose);
    return out;
  }
  static std::string bytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

std::vector<std::vector<double>> numbers_of(const fs::path& path, bool observations_of_images) {
  std::ifstream in(path);
  std::vector<std::vector<double>> out;
  bool second = false;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] == '#') continue;
    second = !second;
    if (observations_of_images && second) continue;
    std::istringstream words(line);
    out.emplace_back();
    for (double v; words >> v;) out.back().push_back(v);
  }
  return out;
}

TEST_F(Products, tracks_of_the_colmap_model_are_exact_and_name_each_other) {
  const fs::path folder = simulated("[truth]\ntie_points = 200\n");
  const auto shown = cameras(folder);
  const auto points = numbers_of(folder / "sparse/points3D.txt", false);
  const auto images = numbers_of(folder / "sparse/images.txt", true);
  ASSERT_EQ(images.size(), shown.size());
  EXPECT_GT(points.size(), 100u);
  EXPECT_LE(points.size(), 200u);
  for (const auto& point : points) {
    ASSERT_GE(point.size(), 8u + 2 * 3);  // three views or more
    const Vec3d position{point[1], point[2], point[3]};
    for (std::size_t k = 8; k < point.size(); k += 2) {
      const auto image = static_cast<std::size_t>(point[k]) - 1, place = static_cast<std::size_t>(point[k + 1]);
      ASSERT_GT(images[image].size(), 3 * place + 2);
      EXPECT_EQ(images[image][3 * place + 2], point[0]);
      const auto pixel = shown[image].project(position);
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(images[image][3 * place], pixel->x, 1e-5);
      EXPECT_NEAR(images[image][3 * place + 1], pixel->y, 1e-5);
    }
  }
  formats::CheckPointFilter filter;
  filter.min_track_length = 3;
  EXPECT_EQ(formats::read_check_points((folder / "sparse").string(), filter).size(), points.size());
  EXPECT_EQ(formats::read_poses((folder / "sparse").string()).images.size(), shown.size());
}

TEST_F(Products, tie_points_lie_on_the_true_surface) {
  const fs::path folder = simulated("[truth]\ntie_points = 200\ncell_m = 0.1\n");
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  int close = 0, all = 0;
  for (const auto& point : formats::read_check_points((folder / "sparse").string())) {
    const Vec2d nw = dsm.georeference.north_west_corner;
    const int column = static_cast<int>((point.position.x - nw.x) / 0.1),
              row = static_cast<int>((nw.y - point.position.y) / 0.1);
    close += std::abs(dsm.values(column, row) - point.position.z) < 0.05;
    ++all;
  }
  EXPECT_GT(close, 0.95 * all);  // the others share their cell with an edge
}

TEST_F(Products, without_tie_points_the_model_has_none) {
  EXPECT_TRUE(numbers_of(simulated("[truth]\ntie_points = 0\n") / "sparse/points3D.txt", false).empty());
}

TEST_F(Products, ground_control_points_are_on_the_ground_and_seen_where_the_list_says) {
  const fs::path folder = simulated("[ground_control]\npoints = 30\n");
  const formats::GcpList list = formats::read_gcp_list((folder / "gcp_list.txt").string());
  EXPECT_EQ(list.crs, "EPSG:32632");
  ASSERT_GE(list.points.size(), 5u);
  const auto poses = formats::read_poses((folder / "poses.csv").string());
  std::map<std::string, camera::Camera> by_name;
  for (const auto& image : poses.images) by_name.emplace(image.name, camera::Camera(image.model, image.pose));
  std::set<std::string> names;
  for (const auto& point : list.points) {
    EXPECT_TRUE(names.insert(point.name).second);
    EXPECT_NEAR(point.position.z, 500, 0.41);  // within the relief: not on a roof
    EXPECT_GE(point.sightings.size(), 3u);
    for (const auto& seen : point.sightings) {
      const auto pixel = by_name.at(seen.image).project(point.position);
      EXPECT_NEAR(seen.pixel.x, pixel->x, 1e-5);
      EXPECT_NEAR(seen.pixel.y, pixel->y, 1e-5);
    }
  }
}

TEST_F(Products, depth_images_lead_to_the_true_surface) {
  const fs::path folder = simulated("[truth]\ndepth = true\ncell_m = 0.05\n");
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  const auto poses = formats::read_poses((folder / "poses.csv").string());
  ASSERT_FALSE(poses.images.empty());
  const auto depth = raster::read_exr(folder / "truth/depth/0001.exr");
  EXPECT_EQ(depth.labels.at("units"), "metre");
  const camera::Camera camera(poses.images[0].model, poses.images[0].pose);
  const Array2d<float>& z = depth.channels.at("Z");
  ASSERT_EQ(z.width(), 200);
  int close = 0, all = 0;
  for (int row = 0; row < z.height(); row += 3)
    for (int column = 0; column < z.width(); column += 3) {
      const Vec3d ray = *camera.ray({column + 0.5, row + 0.5});
      const Vec3d p = camera.pose().center + (z(column, row) / dot(ray, camera.pose().view_direction())) * ray;
      const Vec2d nw = dsm.georeference.north_west_corner;
      const int x = static_cast<int>(std::floor((p.x - nw.x) / 0.05)),
                y = static_cast<int>(std::floor((nw.y - p.y) / 0.05));
      if (!dsm.values.contains(x - 1, y - 1) || !dsm.values.contains(x + 1, y + 1)) continue;
      float highest = dsm.values(x, y);  // of the neighbourhood: an edge may lie within the cell
      for (int k = 0; k < 9; ++k) highest = std::max(highest, dsm.values(x + k % 3 - 1, y + k / 3 - 1));
      EXPECT_LT(p.z, highest + 0.02);
      close += std::abs(p.z - dsm.values(x, y)) < 0.02;
      ++all;
    }
  ASSERT_GT(all, 500);
  EXPECT_GT(close, 0.85 * all);  // the rest is walls
}

TEST_F(Products, light_in_exr_is_what_the_grey_levels_were_made_of) {
  const fs::path exr = simulated("[photographs]\nformat = \"exr\"\n", "exr"),
                 png = simulated("[photographs]\nformat = \"png\"\n", "png");
  const auto light = raster::read_exr(exr / "images/0001.exr");
  const Array2d<Rgb8> levels = raster::read_photo(png / "images/0001.png");
  const Array2d<float>& green = light.channels.at("G");
  ASSERT_EQ(green.width(), levels.width());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double v = std::clamp(1. * green.data()[i], 0., 1.);
    const double level = 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
    EXPECT_NEAR(level, levels.data()[i].g, 0.51);
  }
}

TEST_F(Products, tiff_photographs_have_the_pixels_of_png) {
  const fs::path tif = simulated("[photographs]\nformat = \"tif\"\n", "tif"),
                 png = simulated("[photographs]\nformat = \"png\"\n", "png");
  EXPECT_EQ(raster::read_photo(tif / "images/0002.tif"), raster::read_photo(png / "images/0002.png"));
}

double rational(const Exiv2::Exifdatum& datum, long i = 0) {
  const Exiv2::Rational r = datum.toRational(i);
  return static_cast<double>(static_cast<std::uint32_t>(r.first)) / static_cast<std::uint32_t>(r.second);
}

TEST_F(Products, metadata_says_where_and_how_each_photograph_was_taken) {
  for (const std::string format : {"jpg", "png", "tif"}) {
    const fs::path folder = simulated("[photographs]\nformat = \"" + format +
                                          "\"\n[metadata]\nmake = \"DJI\"\nstart = \"2026-03-01T09:30:00\"\n"
                                          "speed_mps = 4\nsensor_width_mm = 10\n",
                                      format);
    const auto poses = formats::read_poses((folder / "poses.csv").string());
    double way_m = 0;
    for (std::size_t i = 0; i < poses.images.size(); ++i) {
      const auto& expected = poses.images[i];
      const auto image = Exiv2::ImageFactory::open((folder / "images" / expected.name).string());
      image->readMetadata();
      Exiv2::ExifData& exif = image->exifData();
      Exiv2::XmpData& xmp = image->xmpData();
      EXPECT_EQ(exif["Exif.Image.Make"].toString(), "DJI");
      EXPECT_NEAR(rational(exif["Exif.Photo.FocalLength"]), 10, 1e-3);  // 200 px x 10 mm / 200 px
      // By hand: EPSG:32632 at 691000, 5334000 is 48.13 N, 11.57 E (Munich); a metre is 0.00000899 degrees of latitude.
      const auto angle = [&](const std::string& key) {
        const auto& d = exif[key];
        return rational(d, 0) + rational(d, 1) / 60 + rational(d, 2) / 3600;
      };
      EXPECT_NEAR(angle("Exif.GPSInfo.GPSLatitude"), 48.1299, 0.001);
      EXPECT_NEAR(angle("Exif.GPSInfo.GPSLongitude"), 11.5660, 0.002);
      EXPECT_NEAR(rational(exif["Exif.GPSInfo.GPSAltitude"]), expected.pose.center.z, 1e-3);
      const auto degrees = [&](const char* key) {
        return std::stod(xmp["Xmp.drone-dji." + std::string(key)].toString());
      };
      EXPECT_NEAR(degrees("RelativeAltitude"), expected.pose.center.z - 500, 1e-3);
      const Mat3d rotation = camera::rotation_from_yaw_pitch_roll(
          degrees("GimbalYawDegree"), degrees("GimbalPitchDegree"), degrees("GimbalRollDegree"));
      for (std::size_t k = 0; k < 9; ++k)
        EXPECT_NEAR(rotation.m[k], expected.pose.cam_from_world.m[k], 3e-4);  // a hundredth of a degree
      if (i > 0) way_m += norm(expected.pose.center - poses.images[i - 1].pose.center);
      const int milliseconds = static_cast<int>(std::lround(way_m / 4 * 1000));
      char time[40];
      std::snprintf(time, sizeof time, "2026:03:01 09:%02d:%02d", 30 + milliseconds / 60000, milliseconds / 1000 % 60);
      EXPECT_EQ(exif["Exif.Photo.DateTimeOriginal"].toString(), time);
      EXPECT_NEAR(std::stoi(exif["Exif.Photo.SubSecTimeOriginal"].toString()), milliseconds % 1000, 1);
    }
  }
}

TEST_F(Products, metadata_changes_no_pixel) {
  const fs::path plain = simulated("", "plain"), tagged = simulated("[metadata]\n", "tagged");
  EXPECT_NE(bytes(plain / "images/0001.jpg"), bytes(tagged / "images/0001.jpg"));
  EXPECT_EQ(raster::read_photo(plain / "images/0001.jpg"), raster::read_photo(tagged / "images/0001.jpg"));
}

TEST_F(Products, a_scene_without_place_on_earth_gives_no_gps) {
  std::string scene = kScene;
  scene.erase(scene.find("crs"), std::string("crs = \"EPSG:32632\"\n").size());
  SerialExecutor executor;
  simulate(parse_scene(scene + "[metadata]\n", "s.toml"), folder_, executor);
  const auto image = Exiv2::ImageFactory::open((folder_ / "images/0001.jpg").string());
  image->readMetadata();
  EXPECT_EQ(image->exifData().findKey(Exiv2::ExifKey("Exif.GPSInfo.GPSLatitude")), image->exifData().end());
  EXPECT_NE(image->exifData().findKey(Exiv2::ExifKey("Exif.Photo.FocalLength")), image->exifData().end());
}

TEST_F(Products, all_together_are_the_same_for_one_and_two_threads) {
  const std::string more =
      "[photographs]\nformat = \"tif\"\n[metadata]\n[truth]\ndepth = true\n[ground_control]\npoints = 20\n";
  const fs::path one = simulated(more, "one"), two = folder_ / "two";
  ThreadExecutor executor(2);
  simulate(parse_scene(kScene + more, "s.toml"), two, executor);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(one)) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), one);
    EXPECT_EQ(bytes(entry.path()), bytes(two / name)) << name;
    ++files;
  }
  EXPECT_GT(files, 25);
}

std::string refusal(const std::string& text) {
  try {
    const fs::path folder = fs::path(testing::TempDir()) / "products_refused";
    fs::remove_all(folder);
    SerialExecutor executor;
    simulate(parse_scene(text, "s.toml"), folder, executor);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& more, const std::string& words) {
  EXPECT_NE(refusal(kScene + more).find(words), std::string::npos) << refusal(kScene + more);
}

TEST(ProductsFile, wrong_values_are_refused_with_a_sentence) {
  expect_refused("[truth]\ntie_points = -1\n", "tie_points must lie between 0 and 1000000");
  expect_refused("[truth]\ndepth = 1\n", "true or false");
  expect_refused("[ground_control]\npoints = 0\n", "points must lie between 1 and 10000");
  expect_refused("[metadata]\nstart = \"tomorrow\"\n", "must be a time such as");
  expect_refused("[metadata]\nstart = \"2026-02-30T10:00:00\"\n", "must be a time such as");
  expect_refused("[metadata]\nspeed_mps = 0\n", "speed_mps must be above 0");
  expect_refused("[metadata]\nsensor_width_mm = -1\n", "sensor_width_mm must be above 0");
  expect_refused("[metadata]\n[photographs]\nformat = \"exr\"\n", "no effect on EXR");
  expect_refused("[photographs]\nformat = \"exr\"\nnoise_sigma = 2\n", "no effect on EXR");
  expect_refused("[photographs]\nformat = \"tif\"\njpeg_quality = 80\n", "no effect on files other than JPEG");
}

TEST(ProductsFile, ground_control_needs_a_system_that_the_list_can_name) {
  std::string scene = kScene;
  scene.erase(scene.find("crs"), std::string("crs = \"EPSG:32632\"\n").size());
  EXPECT_NE(refusal(scene + "[ground_control]\n").find("set crs"), std::string::npos);
}

TEST(ProductsFile, what_a_scene_names_stands_in_its_json) {
  const std::string json = scene_to_json(parse_scene(
      std::string(kScene) + "[metadata]\nstart = \"2026-03-01T09:30:05\"\n[truth]\ntie_points = 7\ndepth = true\n"
                            "[ground_control]\npoints = 9\n",
      "s.toml"));
  for (const char* part :
       {"\"start\": \"2026-03-01T09:30:05\"", "\"tie_points\": 7", "\"depth\": true", "\"points\": 9"})
    EXPECT_NE(json.find(part), std::string::npos) << part;
  const std::string plain = scene_to_json(parse_scene(kScene, "s.toml"));
  for (const char* part : {"metadata", "tie_points", "depth", "ground_control"})
    EXPECT_EQ(plain.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace skysweep::scene
