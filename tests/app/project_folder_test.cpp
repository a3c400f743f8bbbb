// SPDX-License-Identifier: Apache-2.0
// What runs make of a project folder: the first, the second, the contradicting and the dry one.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/simulated_flight.h"
#include "raster/geotiff.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

using ProjectFolder = SimulatedFlight;

int tiles_computed(const fs::path& project) { return report_of(project).at("tiles").at("computed"); }

TEST_F(ProjectFolder, holds_the_whole_map) {
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_map(project(), kPhotographs);
  for (const char* file : {"project.toml", "catalog.gpkg", "dsm.tif", "ortho.tif", "confidence.tif", "mask.tif",
                           "preview.png", "report.json", "run.log", "tiles/dem/top.tif"})
    EXPECT_TRUE(fs::exists(project() / file)) << file;
}

TEST_F(ProjectFolder, second_run_computes_no_tile_and_changes_no_byte) {
  EXPECT_EQ(run().exit_code, 0);
  const auto before = rasters_in(project());
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(tiles_computed(project()), 0);
  EXPECT_TRUE(rasters_in(project()) == before);
}

TEST_F(ProjectFolder, photograph_that_arrives_later_gives_the_map_of_all) {
  // The plane step is fixed: a new project would derive it from the photographs it finds.
  EXPECT_EQ(run({"--dz=0.05"}, "at_once").exit_code, 0);
  fs::rename(photo("0006.jpg"), folder / "0006.jpg");
  EXPECT_EQ(run({"--dz=0.05"}).exit_code, 0);
  expect_map(project(), kPhotographs - 1);
  fs::rename(folder / "0006.jpg", photo("0006.jpg"));
  EXPECT_EQ(run({"--dz=0.05"}).exit_code, 0);
  EXPECT_TRUE(rasters_in(project()) == rasters_in(project("at_once")));
}

TEST_F(ProjectFolder, contradicting_settings_are_refused_with_the_difference) {
  EXPECT_EQ(run().exit_code, 0);
  const auto before = rasters_in(project());
  const auto expect_refused = [&](const Arguments& more, const std::vector<std::string>& words) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, words));
    EXPECT_TRUE(says(outcome.err, {"--fresh"}));
  };
  expect_refused({"--dz", "0.5"}, {"--dz", "0.5"});
  expect_refused({"--crs", "EPSG:32632"}, {"the CRS", "32N"});
  expect_refused({"--backend", "reference"}, {"--backend cpu", "reference"});
  expect_refused({"--z-range=-3,5"}, {"--z-range -2,5", "-3,5"});
  expect_refused({"--no-fill"}, {"fill = true", "fill = false"});
  expect_refused({"--planar-fallback"}, {"planar_fallback"});
  put_bytes(folder / "small_tiles.toml", "[tiles]\ncells = 128\ncollar_cells = 16\n");
  expect_refused({}, {"[tiles]", "cells = 64", "cells = 128"});
  EXPECT_TRUE(rasters_in(project()) == before);
}

// On a GPU or, as in CI, on the software device: the same map, and a record of what made it. Each stage agrees within
// the bounds of tests/contract. From coarse to fine, a difference in the last digit can tip the rounding of a slope for
// the next grid, and with it the smoothing around: of the whole chain all but 5 % of the cells agree to a centimetre.
TEST_F(ProjectFolder, gpu_backend_makes_the_same_map_and_is_recorded) {
  const Outcome outcome = run({"--backend", "gpu"}, "gpu");
  if (says(outcome.err, {"Use --backend cpu"})) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(says(outcome.err, {"what the GPU could not"})) << outcome.err;
  const std::string device = report_of(project("gpu")).at("gpu_device");
  EXPECT_FALSE(device.empty());
  EXPECT_EQ(device.find("llvmpipe") != std::string::npos, says(outcome.err, {"software device"})) << outcome.err;
  EXPECT_TRUE(says(file_bytes(project("gpu") / "project.toml"), {"backend = \"gpu\"", device}));
  EXPECT_EQ(run({"--backend", "cpu"}, "cpu").exit_code, 0);
  const auto by_gpu = raster::read_float_raster(project("gpu") / "dsm.tif").values;
  const auto by_cpu = raster::read_float_raster(project("cpu") / "dsm.tif").values;
  ASSERT_EQ(by_gpu.size(), by_cpu.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < by_cpu.size(); ++i) {
    const float a = by_gpu.data()[i], b = by_cpu.data()[i];
    different += std::isnan(a) != std::isnan(b) || std::abs(a - b) > 0.01f;
  }
  EXPECT_LE(different, by_cpu.size() / 20);
}

TEST_F(ProjectFolder, fresh_starts_over) {
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(run({"--fresh", "--dz", "0.2"}).exit_code, 0);
  EXPECT_GT(tiles_computed(project()), 0);
  EXPECT_EQ(run({"--dz", "0.2"}, "other").exit_code, 0);
  EXPECT_TRUE(rasters_in(project()) == rasters_in(project("other")));
}

TEST_F(ProjectFolder, dry_run_writes_nothing) {
  const Outcome outcome = run({"--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(
      says(outcome.out, {"6 of 6 photographs would be used", "tiles", "Memory", "Disk", "Nothing was written"}));
  EXPECT_FALSE(fs::exists(project()));
}

TEST_F(ProjectFolder, area_of_interest_limits_tiles_and_mosaics) {
  EXPECT_EQ(run({}, "whole").exit_code, 0);
  EXPECT_EQ(run({"--aoi=2,1,5,4.5"}).exit_code, 0);
  EXPECT_LT(tiles_computed(project()), tiles_computed(project("whole")));
  const Box2d extent = raster::read_float_raster(project() / "dsm.tif").extent();
  EXPECT_NEAR(extent.min.x, 2, 0.11);
  EXPECT_NEAR(extent.min.y, 1, 0.11);
  EXPECT_NEAR(extent.max.x, 5, 0.11);
  EXPECT_NEAR(extent.max.y, 4.5, 0.11);
  // Its tiles are those of the whole map.
  const auto whole = rasters_in(project("whole"));
  for (const auto& [name, bytes] : rasters_in(project()))
    if (name.find("/l0/") != std::string::npos) {
      EXPECT_TRUE(bytes == whole.at(name)) << name;
    }
}

TEST_F(ProjectFolder, planar_fallback_marks_its_cells) {
  const auto cells_marked_3 = [&](const std::string& name) {
    const Array2d<std::uint8_t> mask = raster::read_class_raster(project(name) / "mask.tif").values;
    return std::count(mask.begin(), mask.end(), 3);
  };
  EXPECT_EQ(run({}, "without").exit_code, 0);
  EXPECT_EQ(run({"--planar-fallback"}, "with").exit_code, 0);
  EXPECT_EQ(cells_marked_3("without"), 0);
  EXPECT_GT(cells_marked_3("with"), 0);
}

TEST_F(ProjectFolder, no_fill_leaves_the_cells_empty_that_else_are_filled) {
  EXPECT_EQ(run({}, "with").exit_code, 0);
  EXPECT_EQ(run({"--no-fill"}, "without").exit_code, 0);
  put_bytes(folder / "no_fill.toml", "[tiles]\ncells = 64\ncollar_cells = 16\n[sweep]\nfill = false\n");
  EXPECT_EQ(run({"--config", folder / "no_fill.toml"}, "configured").exit_code, 0);
  const auto layer = [&](const std::string& name, const char* file) {
    return raster::read_float_raster(project(name) / file).values;
  };
  const Array2d<std::uint8_t> mask = raster::read_class_raster(project("with") / "mask.tif").values;
  const Array2d<std::uint8_t> empty = raster::read_class_raster(project("without") / "mask.tif").values;
  ASSERT_EQ(mask.size(), empty.size());
  const Array2d<float> filled_dsm = layer("with", "dsm.tif"), sigma = layer("with", "confidence.tif");
  const Array2d<float> dsm = layer("without", "dsm.tif");
  int filled = 0, different = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const bool is_filled = mask.data()[i] == 2;
    filled += is_filled;
    different += empty.data()[i] != (is_filled ? 0 : mask.data()[i]);
    different += std::isnan(filled_dsm.data()[i]) != (mask.data()[i] == 0);
    different += std::isnan(sigma.data()[i]) != (mask.data()[i] != 1);
    different += !is_filled && !std::isnan(dsm.data()[i]) && dsm.data()[i] != filled_dsm.data()[i];
    different += is_filled && !std::isnan(dsm.data()[i]);
  }
  EXPECT_GT(filled, 0);
  EXPECT_EQ(different, 0);
  EXPECT_TRUE(file_bytes(project("without") / "dsm.tif") == file_bytes(project("configured") / "dsm.tif"));
  const nlohmann::json cells = report_of(project("with")).at("cells");
  EXPECT_EQ(report_of(project("without")).at("cells").at("filled"), 0);
  EXPECT_EQ(cells.at("filled"), filled);
  EXPECT_EQ(cells.at("measured"), std::count(mask.begin(), mask.end(), 1));
}

TEST_F(ProjectFolder, every_line_of_the_json_log_is_json) {
  put_bytes(photo("0002.jpg"), "");
  const Outcome outcome = run({"--json-log"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::istringstream lines(outcome.out);
  std::map<std::string, int> events;
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json event = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(event.is_object()) << line;
    ++events[event.at("event")];
  }
  EXPECT_GT(events["progress"], 0);
  EXPECT_EQ(events["warning"], 1);
  EXPECT_GT(events["result"], 0);
}

TEST_F(ProjectFolder, poses_with_an_origin_move_the_map_as_a_whole) {
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(run({"--origin=512000,5403200,0", "--crs", "EPSG:32632"}, "far").exit_code, 0);
  const raster::Raster<float> near = raster::read_float_raster(project() / "dsm.tif");
  const raster::Raster<float> far = raster::read_float_raster(project("far") / "dsm.tif");
  EXPECT_NEAR(far.georeference.north_west_corner.x - near.georeference.north_west_corner.x, 512000, 1e-6);
  EXPECT_NEAR(far.georeference.north_west_corner.y - near.georeference.north_west_corner.y, 5403200, 1e-6);
  EXPECT_TRUE(same_bits(near.values, far.values));
}

}  // namespace
}  // namespace skysweep::app_test
