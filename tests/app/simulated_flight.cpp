// SPDX-License-Identifier: Apache-2.0
#include "app/simulated_flight.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "raster/geotiff.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

constexpr const char* kScene = R"(
seed = 5
area_m = [14, 10]

[terrain]
relief_m = 0.5

[[building]]
center = [1, 0]
size_m = [4, 3]
roof_z_m = 3

[camera]
width_px = 320
height_px = 240
focal_px = 310

[flight]
gsd_m = 0.05
along_overlap = 0.7
across_overlap = 0.6
beyond_area_m = -3.5
)";

constexpr const char* kSmallTiles = R"([tiles]
cells = 64
collar_cells = 16
)";

// Made by the first test of a process, removed when the process ends.
class SharedScene {
 public:
  SharedScene() : path_(fs::path(testing::TempDir()) / ("app_test_scene." + std::to_string(::getpid()))) {
    put_bytes(path_ / "scene.toml", kScene);
    const Outcome simulated = skysweep({"simulate", path_ / "scene.toml", "-o", path_ / "flight"});
    if (simulated.exit_code != 0) throw std::runtime_error("The scene cannot be simulated: " + simulated.err);
  }
  ~SharedScene() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path flight() const { return path_ / "flight"; }

 private:
  fs::path path_;
};

const SharedScene& shared_scene() {
  static const SharedScene scene;
  return scene;
}

}  // namespace

SimulatedFlight::SimulatedFlight() {
  const fs::path flight = shared_scene().flight();
  fs::copy(flight / "images", images());
  fs::copy(flight / "poses.csv", poses());
  put_bytes(folder / "small_tiles.toml", kSmallTiles);
}

fs::path SimulatedFlight::truth() const { return shared_scene().flight() / "truth" / "dsm.tif"; }

Arguments SimulatedFlight::run_arguments(const Arguments& more, const std::string& project_name) const {
  Arguments all = {"run", images(), "--poses=" + poses().string(), "-o", project(project_name)};
  const auto option_of = [](const std::string& argument) { return argument.substr(0, argument.find('=')); };
  for (const std::string& standard : {"--config=" + (folder / "small_tiles.toml").string(), std::string("--cell=0.1"),
                                      std::string("--threads=2"), std::string(kHeights)})
    if (std::none_of(more.begin(), more.end(), [&](const auto& a) { return option_of(a) == option_of(standard); }))
      all.push_back(standard);
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Outcome SimulatedFlight::run(const Arguments& more, const std::string& project_name) const {
  return skysweep(run_arguments(more, project_name));
}

void SimulatedFlight::replace_in_poses(const std::string& text, const std::string& by) const {
  std::string csv = file_bytes(poses());
  const std::size_t at = csv.find(text);
  ASSERT_NE(at, std::string::npos) << text << " is not in\n" << csv;
  put_bytes(poses(), csv.replace(at, text.size(), by));
}

cv::Mat SimulatedFlight::pixels_of(const std::string& photo_name) const {
  return cv::imread(photo(photo_name), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

nlohmann::json report_of(const fs::path& project) { return nlohmann::json::parse(file_bytes(project / "report.json")); }

nlohmann::json image_in_report(const fs::path& project, const std::string& name) {
  const nlohmann::json report = report_of(project);
  for (const nlohmann::json& image : report.at("images"))
    if (image.at("name") == name) return image;
  ADD_FAILURE() << "the report does not name " << name;
  return {};
}

int photographs_used(const fs::path& project) {
  const nlohmann::json report = report_of(project);
  const auto& images = report.at("images");
  return static_cast<int>(
      std::count_if(images.begin(), images.end(), [](const auto& image) { return image.at("status") == "used"; }));
}

Array2d<float> heights_in(const fs::path& dsm) { return raster::read_float_raster(dsm).values; }

bool same_bits(const Array2d<float>& a, const Array2d<float>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

double share_with_height(const fs::path& project) {
  const Array2d<float> heights = heights_in(project / "dsm.tif");
  const auto known = std::count_if(heights.begin(), heights.end(), [](float z) { return !std::isnan(z); });
  return static_cast<double>(known) / static_cast<double>(heights.size());
}

std::map<std::string, std::string> rasters_in(const fs::path& project) {
  std::map<std::string, std::string> found;
  if (!fs::exists(project)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(project))
    if (entry.path().extension() == ".tif")
      found[entry.path().lexically_relative(project).generic_string()] = file_bytes(entry.path());
  return found;
}

void expect_map(const fs::path& project, int used) {
  EXPECT_EQ(photographs_used(project), used);
  EXPECT_GT(share_with_height(project), 0.5);
  int tiles = 0;
  for (const auto& entry : fs::recursive_directory_iterator(project / "tiles" / "dem")) {
    if (entry.path().extension() != ".tif") continue;
    EXPECT_NO_THROW(heights_in(entry.path()));
    ++tiles;
  }
  EXPECT_GT(tiles, 4);
}

testing::AssertionResult says(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (text.find(word) == std::string::npos)
      return testing::AssertionFailure() << "'" << word << "' is not in: " << text;
  return testing::AssertionSuccess();
}

}  // namespace skysweep::app_test
