// SPDX-License-Identifier: Apache-2.0
// Scenes with exact truth, mapped as a user would, against the figures in expected.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "accuracy/expectations.h"
#include "accuracy/sigma_bars.h"
#include "export/mosaic.h"
#include "pipeline/session.h"
#include "pipeline/tbb_executor.h"
#include "raster/class_names.h"
#include "raster/temp_folder.h"
#include "report/class_accuracy.h"
#include "report/evaluation.h"
#include "report/height_accuracy.h"
#include "report/registration.h"
#include "report/sigma_quality.h"
#include "report/surface_sampler.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace skysweep::accuracy {

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

scene::Simulation simulated(const std::string& name, const fs::path& folder) {
  pipeline::TbbExecutor executor(kThreads);
  return scene::simulate(scene::read_scene(scene_file(name)), folder, executor);
}

// Of steps of more than a metre within ten GSD of buildings; nothing without buildings.
void add_building_edges(const report::HeightDifferences& cells, const report::ClassMap& classes, double gsd_m,
                        std::map<std::string, double>& out) {
  const Array2d<std::uint8_t> region = report::building_region(classes, 10 * gsd_m, cells.grid.cell_m);
  if (region.empty()) return;
  const report::EdgeAccuracy edges = report::edge_accuracy(cells, 1, gsd_m, &region);
  out["edge_f_1_gsd"] = edges.scores[0].f_score();
  out["edge_f_2_gsd"] = edges.scores[1].f_score();
  out["edge_displacement_gsd"] = std::abs(edges.steps.median_m) / gsd_m;
}

void add_sigma(const raster::Raster<float>& confidence, const report::HeightDifferences& cells,
               const report::ClassMap& classes, std::map<std::string, double>& out) {
  const Array2d<float> sigma =
      report::sampled_on_grid(confidence, cells.grid, cells.truth.width(), cells.truth.height());
  report::SigmaQuality quality = report::sigma_quality(cells.dz, sigma, static_cast<std::int64_t>(cells.dz.size()), 1);
  quality.classes = report::coverage_by_class(cells.dz, sigma, classes);
  out["sigma_within_68"] = quality.overall.within_68;
  out["sigma_within_95"] = quality.overall.within_95;
  out.merge(sigma_misses(quality));
}

// All figures a row of expected.csv may name, of the flight in folder / "flight" mapped with a preset.
std::map<std::string, double> figures(const scene::Simulation& flight, const std::string& preset,
                                      const fs::path& folder) {
  pipeline::RunRequest request;
  request.images = folder / "flight" / "images";
  request.poses = folder / "flight" / "poses.csv";
  request.project = folder / preset;
  request.preset = preset;
  request.cell_m = flight.truth_cell_m;
  request.threads = kThreads;
  pipeline::Progress silence;
  const pipeline::RunSummary summary = pipeline::run(request, silence, false);

  const pipeline::ProjectPaths paths(request.project);
  const tiles::TileStore store = pipeline::open_store(paths, summary.settings);
  const Box2d extent = exports::known_extent(store);
  exports::write_mosaic(store, "dem", extent, paths.mosaic("dsm"));
  exports::write_mosaic(store, "confidence", extent, paths.mosaic("confidence"));
  exports::write_mosaic(store, "color", extent, paths.mosaic("ortho"));

  const fs::path truth = folder / "flight" / "truth";
  raster::Raster<std::uint8_t> seen = raster::read_class_raster(truth / "views.tif");
  for (std::uint8_t& views : seen.values) views = views >= kViewsThatMustDo;
  const report::HeightDifferences cells = report::height_differences(raster::read_float_raster(paths.mosaic("dsm")),
                                                                     raster::read_float_raster(truth / "dsm.tif"));
  const report::HeightAccuracy heights = report::accuracy_of(cells, &seen.values, {flight.gsd_m});
  report::RegistrationOptions blocks;
  blocks.block_cells = 32;  // small enough to fit between the holes that streets and walls leave
  const report::Registration ortho = report::compare_orthophotos(
      raster::read_color_raster(paths.mosaic("ortho")), raster::read_color_raster(truth / "ortho.tif"), blocks);
  const report::HeightErrors& all = heights.overall;
  std::map<std::string, double> out = {{"completeness", all.valid_share()},
                                       {"median_absolute_gsd", all.median_absolute_m / flight.gsd_m},
                                       {"le90_gsd", all.le90_m / flight.gsd_m},
                                       {"within_2_gsd_where_3_views", heights.masked->within_of_all[1]},
                                       {"bias_plane_steps", std::abs(all.median_m) / summary.settings.lattice.dz_m},
                                       {"ortho_shift_cells", ortho.median_shift_cells},
                                       {"ortho_blocks_used", ortho.used_share()}};
  const report::ClassMap classes{raster::read_class_raster(truth / "classes.tif").values,
                                 raster::read_class_names(truth / "classes.tif")};
  for (const report::ClassErrors& one : report::accuracy_by_class(cells, classes, flight.gsd_m)) {
    std::string name = one.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    out[name + "_within_2_gsd"] = one.errors.within_of_all[1];
  }
  add_building_edges(cells, classes, flight.gsd_m, out);
  add_sigma(raster::read_float_raster(paths.mosaic("confidence")), cells, classes, out);
  return out;
}

// A scene with everything that is stored about it.
struct SceneCases {
  std::vector<Case> cases;
  const std::string& name() const { return cases.front().scene; }
  friend std::ostream& operator<<(std::ostream& out, const SceneCases& s) { return out << s.name(); }
};

class SceneAccuracy : public testing::TestWithParam<SceneCases> {};

TEST_P(SceneAccuracy, is_no_worse_than_stored) {
  const testing_support::TempFolder folder;
  const scene::Simulation flight = simulated(GetParam().name(), folder / "flight");
  for (const Case& stored : GetParam().cases) {
    SCOPED_TRACE(stored.preset);
    const std::map<std::string, double> measured = figures(flight, stored.preset, folder.path());
    for (const auto& [metric, value] : measured) RecordProperty(stored.preset + "." + metric, std::to_string(value));
    for (const Expectation& e : stored.expectations) {
      ASSERT_TRUE(measured.contains(e.metric)) << "expected.csv names a metric that nobody measures: " << e.metric;
      EXPECT_TRUE(e.met_by(measured.at(e.metric))) << e.metric << " is " << measured.at(e.metric) << ", worse than "
                                                   << e.limit() << " (was " << e.measured << ")";
    }
  }
}

std::vector<SceneCases> cases_by_scene() {
  std::vector<SceneCases> scenes;
  for (const Case& stored : read_expectations(kHere / "expected.csv")) {
    if (scenes.empty() || scenes.back().name() != stored.scene) scenes.emplace_back();
    scenes.back().cases.push_back(stored);
  }
  return scenes;
}

INSTANTIATE_TEST_SUITE_P(Stored, SceneAccuracy, testing::ValuesIn(cases_by_scene()),
                         [](const auto& scene) { return scene.param.name(); });

}  // namespace
}  // namespace skysweep::accuracy
