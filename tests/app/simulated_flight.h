// SPDX-License-Identifier: Apache-2.0
// Six small photographs that the program itself has simulated, and a folder for each test to spoil them in.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "app/program.h"
#include "core/array2d.h"
#include "raster/temp_folder.h"

namespace skysweep::app_test {

inline constexpr int kPhotographs = 6;
inline constexpr const char* kHeights = "--z-range=-2,5";  // holds the scene; saves looking for the ground

class SimulatedFlight : public testing::Test {
 protected:
  SimulatedFlight();

  std::filesystem::path truth() const;  // true surface
  std::filesystem::path photo(const std::string& name) const { return images() / name; }
  std::filesystem::path images() const { return folder / "images"; }
  std::filesystem::path poses() const { return folder / "poses.csv"; }
  std::filesystem::path project(const std::string& name = "project") const { return folder / name; }

  // Arguments of `run` for a map in about a third of a second: small tiles, heights given. `more` comes before these.
  Arguments run_arguments(const Arguments& more = {}, const std::string& project_name = "project") const;
  Outcome run(const Arguments& more = {}, const std::string& project_name = "project") const;

  void replace_in_poses(const std::string& text, const std::string& by) const;
  cv::Mat pixels_of(const std::string& photo_name) const;

  testing_support::TempFolder folder;
};

nlohmann::json report_of(const std::filesystem::path& project);
// The report's entry of a photograph.
nlohmann::json image_in_report(const std::filesystem::path& project, const std::string& name);
int photographs_used(const std::filesystem::path& project);

Array2d<float> heights_in(const std::filesystem::path& dsm);
bool same_bits(const Array2d<float>& a, const Array2d<float>& b);  // NaN equals NaN
double share_with_height(const std::filesystem::path& project);    // of the cells of the surface

// Contents of all rasters below a project folder, by relative path.
std::map<std::string, std::string> rasters_in(const std::filesystem::path& project);

// The map is whole: `used` photographs served it, it has heights, and every tile can be read.
void expect_map(const std::filesystem::path& project, int used);

// A sentence holds all of these words.
testing::AssertionResult says(const std::string& text, const std::vector<std::string>& words);

}  // namespace skysweep::app_test
