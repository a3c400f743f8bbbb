// SPDX-License-Identifier: Apache-2.0
// Scenes with exact truth, mapped as a user would, against the figures in expected.csv.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <ostream>

#include "accuracy/expectations.h"
#include "export/mosaic.h"
#include "pipeline/session.h"
#include "pipeline/tbb_executor.h"
#include "raster/temp_folder.h"
#include "report/height_accuracy.h"
#include "report/registration.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace skysweep::accuracy {

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.scene << ", " << c.preset; }

namespace {

namespace fs = std::filesystem;

constexpr int kThreads = 2;
constexpr int kViewsThatMustDo = 3;  // where so many photographs see a place, there is no excuse

const fs::path kSource = SKYSWEEP_SOURCE_DIR;
const fs::path kHere = kSource / "tests" / "accuracy";

// Scenes of the project, and those that serve only here.
fs::path scene_file(const std::string& name) {
  const fs::path example = kSource / "config" / "scenes" / (name + ".toml");
  return fs::exists(example) ? example : kHere / "scenes" / (name + ".toml");
}

// All figures a row of expected.csv may name.
std::map<std::string, double> figures(const Case& wanted, const fs::path& folder) {
  pipeline::TbbExecutor executor(kThreads);
  const scene::Simulation flight =
      scene::simulate(scene::read_scene(scene_file(wanted.scene)), folder / "flight", executor);

  pipeline::RunRequest request;
  request.images = folder / "flight" / "images";
  request.poses = folder / "flight" / "poses.csv";
  request.project = folder / "project";
  request.preset = wanted.preset;
  request.cell_m = flight.truth_cell_m;
  request.threads = kThreads;
  pipeline::Progress silence;
  const pipeline::RunSummary summary = pipeline::run(request, silence, false);

  const pipeline::ProjectPaths paths(request.project);
  const tiles::TileStore store = pipeline::open_store(paths, summary.settings);
  const Box2d extent = exports::known_extent(store);
  exports::write_mosaic(store, "dem", extent, paths.mosaic("dsm"));
  exports::write_mosaic(store, "color", extent, paths.mosaic("ortho"));

  const fs::path truth = folder / "flight" / "truth";
  raster::Raster<std::uint8_t> seen = raster::read_class_raster(truth / "views.tif");
  for (std::uint8_t& views : seen.values) views = views >= kViewsThatMustDo;
  const report::HeightAccuracy heights =
      report::compare_surfaces(raster::read_float_raster(paths.mosaic("dsm")),
                               raster::read_float_raster(truth / "dsm.tif"), &seen, {flight.gsd_m});
  report::RegistrationOptions blocks;
  blocks.block_cells = 32;  // small enough to fit between the holes that streets and walls leave
  const report::Registration ortho = report::compare_orthophotos(
      raster::read_color_raster(paths.mosaic("ortho")), raster::read_color_raster(truth / "ortho.tif"), blocks);
  const report::HeightErrors& all = heights.overall;
  return {{"completeness", all.valid_share()},
          {"median_absolute_gsd", all.median_absolute_m / flight.gsd_m},
          {"le90_gsd", all.le90_m / flight.gsd_m},
          {"within_2_gsd_where_3_views", heights.masked->within_of_all[1]},
          {"bias_plane_steps", std::abs(all.median_m) / summary.settings.lattice.dz_m},
          {"ortho_shift_cells", ortho.median_shift_cells},
          {"ortho_blocks_used", ortho.used_share()}};
}

class SceneAccuracy : public testing::TestWithParam<Case> {};

TEST_P(SceneAccuracy, is_no_worse_than_stored) {
  const testing_support::TempFolder folder;
  const std::map<std::string, double> measured = figures(GetParam(), folder.path());
  for (const auto& [metric, value] : measured) RecordProperty(metric, std::to_string(value));
  for (const Expectation& e : GetParam().expectations) {
    ASSERT_TRUE(measured.contains(e.metric)) << "expected.csv names a metric that nobody measures: " << e.metric;
    EXPECT_TRUE(e.met_by(measured.at(e.metric)))
        << e.metric << " is " << measured.at(e.metric) << ", worse than " << e.limit() << " (was " << e.measured << ")";
  }
}

INSTANTIATE_TEST_SUITE_P(Stored, SceneAccuracy, testing::ValuesIn(read_expectations(kHere / "expected.csv")),
                         [](const auto& stored) { return stored.param.scene + "_" + stored.param.preset; });

}  // namespace
}  // namespace skysweep::accuracy
