// SPDX-License-Identifier: Apache-2.0
// Wrong settings and wrong pose files end the run at once, with a sentence that says what to change.
#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

class BadInput : public SimulatedFlight {
 protected:
  void expect_refused(const Outcome& outcome, int exit_code, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_TRUE(says(outcome.err, words));
    EXPECT_FALSE(fs::exists(project() / "project.toml")) << "a refused run leaves no project";
  }
};

TEST_F(BadInput, unknown_key_of_a_configuration_is_named_with_the_nearest) {
  put_bytes(folder / "small_tiles.toml", "[tiles]\ncels = 64\n");
  expect_refused(run(), 2, {"small_tiles.toml", "2", "cels", "cells"});
}

TEST_F(BadInput, value_of_a_configuration_that_makes_no_sense) {
  put_bytes(folder / "small_tiles.toml", "[tiles]\ncells = 65\n");
  expect_refused(run(), 2, {"small_tiles.toml", "cells must be a multiple of 64"});
}

TEST_F(BadInput, fewer_speckle_cells_than_none) {
  put_bytes(folder / "speckles.toml", "[sweep]\nspeckle_cells = -1\n");
  expect_refused(run({"--config", folder / "speckles.toml"}), 2, {"speckles.toml", "speckle_cells must lie between 0"});
}

TEST_F(BadInput, cost_that_the_backend_does_not_know) {
  put_bytes(folder / "cost.toml", "[sweep]\ncost = \"census\"\n");
  expect_refused(run({"--config", folder / "cost.toml", "--backend", "gpu"}), 2, {"sad", "census", "--backend cpu"});
  put_bytes(folder / "cost.toml", "[sweep]\ncost = \"ssd\"\n");
  expect_refused(run({"--config", folder / "cost.toml"}), 2, {"cost.toml", "must be one of", "zncc"});
}

TEST_F(BadInput, orthophoto_of_no_kind) {
  put_bytes(folder / "ortho.toml", "[sweep]\northophoto = \"median\"\n");
  expect_refused(run({"--config", folder / "ortho.toml"}), 2, {"ortho.toml", "must be one of", "best", "mean"});
}

TEST_F(BadInput, cell_of_no_size) { expect_refused(run({"--cell=0"}), 2, {"--cell must be a positive number"}); }

TEST_F(BadInput, options_without_sense_are_usage_errors) {
  expect_refused(run({"--dz", "-1"}), 2, {"--dz", "positive"});
  expect_refused(run({"--z-range=5,-2"}), 2, {"--z-range", "LOW not above HIGH"});
  expect_refused(run({"--aoi=3,3,1,1"}), 2, {"--aoi", "x0 < x1"});
  expect_refused(run({"--origin=1,2"}), 2, {"--origin", "X,Y,Z"});
  expect_refused(run({"--memory", "much"}), 2, {"--memory", "4GiB"});
  expect_refused(run({"--backend", "abacus"}), 2, {"--backend", "abacus"});
  expect_refused(run({"--nonsense"}), 2, {"--nonsense"});
}

TEST_F(BadInput, unknown_preset_names_the_nearest) {
  expect_refused(run({"--preset", "balancd"}), 2, {"--preset", "balancd", "did you mean balanced"});
}

TEST_F(BadInput, unknown_coordinate_system) { expect_refused(run({"--crs", "EPSG:999999"}), 2, {"EPSG:999999"}); }

TEST_F(BadInput, missing_pose_file) {
  fs::remove(poses());
  expect_refused(run(), 3, {"poses.csv"});
}

TEST_F(BadInput, pose_file_without_a_column) {
  replace_in_poses("image,x,y,z,", "image,x,y,height,");
  expect_refused(run(), 3, {"poses.csv", "z"});
}

TEST_F(BadInput, pose_line_that_is_no_number_costs_its_photograph_only) {
  const std::string csv = file_bytes(poses());
  const std::size_t line = csv.find("\n0002.jpg,") + 1, end = csv.find('\n', line);
  put_bytes(poses(), csv.substr(0, line) + "0002.jpg,north,6,15" +
                         csv.substr(csv.find(",0,1", line), end - csv.find(",0,1", line)) + csv.substr(end));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.err, {"poses.csv", "0002.jpg", "north"}));
  expect_map(project(), kPhotographs - 1);
}

TEST_F(BadInput, missing_or_empty_folder_of_photographs) {
  fs::remove_all(images());
  expect_refused(run(), 3, {"images", "does not exist"});
  fs::create_directories(images());
  expect_refused(run(), 3, {"There are no photographs in"});
}

TEST_F(BadInput, too_little_memory_says_how_much_is_needed) {
  const Outcome outcome = run({"--memory", "50MiB"});
  expect_refused(outcome, 4, {"--memory allows 50 MiB", "needs", "MiB"});
  // What it says is enough.
  const std::size_t number = outcome.err.find("needs ") + 6;
  const std::string needed = outcome.err.substr(number, outcome.err.find(' ', number) - number);
  EXPECT_EQ(run({"--memory", needed + "MiB"}).exit_code, 0);
}

TEST_F(BadInput, unwritable_output) {
  put_bytes(project(), "a file where the folder should be");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(says(outcome.err, {project().string(), "cannot"}));
  EXPECT_EQ(file_bytes(project()), "a file where the folder should be");
}

}  // namespace
}  // namespace skysweep::app_test
