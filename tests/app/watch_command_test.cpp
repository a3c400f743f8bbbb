// SPDX-License-Identifier: Apache-2.0
// `skysweep watch` from outside. How it lives with files that come and go: scripts/watch_test.py.
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

class WatchCommand : public SimulatedFlight {
 protected:
  WatchCommand() { fs::copy(poses(), images() / "poses.csv"); }

  fs::path maps() const { return folder / "maps"; }

  Arguments arguments(const Arguments& more = {}) const {
    Arguments all = {
        "watch",      images(),    "-o",          maps(),  "--config=" + (folder / "small_tiles.toml").string(),
        "--cell=0.1", "--dz=0.05", "--threads=2", kHeights};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome once(Arguments more = {}) const {
    more.push_back("--once");
    return skysweep(arguments(more));
  }
  nlohmann::json status() const { return nlohmann::json::parse(file_bytes(maps() / "status.json")); }
};

TEST_F(WatchCommand, makes_the_map_that_a_run_makes) {
  const Outcome watched = once();
  ASSERT_EQ(watched.exit_code, 0) << watched.err;
  ASSERT_EQ(run({"--dz=0.05"}).exit_code, 0);
  EXPECT_EQ(rasters_in(maps() / "map"), rasters_in(project()));
  EXPECT_EQ(file_bytes(maps() / "map/dsm.vrt"), file_bytes(project() / "dsm.vrt"));
  EXPECT_EQ(status().at("mapped"), kPhotographs);
  EXPECT_TRUE(says(watched.err, {"skysweep watch: ", "6 of 6 photographs in 1 map"}));
}

TEST_F(WatchCommand, and_a_run_goes_on_with_what_it_made) {
  ASSERT_EQ(once().exit_code, 0);
  const Outcome continued =
      skysweep({"run", images(), "--poses=" + poses().string(), "-o", maps() / "map", "--threads=1"});
  ASSERT_EQ(continued.exit_code, 0) << continued.err;
  EXPECT_TRUE(says(continued.out, {"0 tiles computed"})) << continued.out;
  ASSERT_EQ(once().exit_code, 0);
  EXPECT_EQ(status().at("groups").at(0).at("tiles_computed"), 0);
}

TEST_F(WatchCommand, each_folder_is_a_map_and_names_may_be_odd) {
  const fs::path first = images() / "flight 1", second = images() / "flight..2";
  for (const fs::path& flight : {first, second}) {
    fs::create_directories(flight);
    fs::copy(poses(), flight / "poses.csv");
    for (int i = 1; i <= kPhotographs; ++i) fs::copy(images() / ("000" + std::to_string(i) + ".jpg"), flight);
  }
  for (int i = 1; i <= kPhotographs; ++i) fs::remove(images() / ("000" + std::to_string(i) + ".jpg"));
  // A name that no table could hold has its pose in a file beside it.
  std::istringstream table(file_bytes(poses()));
  std::string header, row;
  std::getline(table, header);
  std::getline(table, row);
  ASSERT_TRUE(row.starts_with("0001.jpg,"));
  const std::string odd = "new\nline, \"quote\" ..";
  fs::rename(first / "0001.jpg", first / (odd + ".jpg"));
  put_bytes(first / (odd + ".csv"), header.substr(header.find(',') + 1) + "\n" + row.substr(row.find(',') + 1) + "\n");

  const Outcome outcome = once({"--group=folder"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json groups = status().at("groups");
  ASSERT_EQ(groups.size(), 2u);
  for (const nlohmann::json& group : groups) {
    EXPECT_EQ(group.at("photographs"), kPhotographs);
    EXPECT_EQ(group.at("state"), "up to date");
    expect_map(maps() / group.at("name").get<std::string>(), kPhotographs);
  }
  EXPECT_EQ(groups.at(0).at("name"), "flight..2");
}

TEST_F(WatchCommand, a_pose_file_elsewhere_and_json_for_machines) {
  fs::remove(images() / "poses.csv");
  const Outcome outcome = once({"--poses=" + poses().string(), "--json-log"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(status().at("mapped"), kPhotographs);
  std::istringstream lines(outcome.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_NO_THROW(nlohmann::json::parse(line)) << line;
  EXPECT_GT(count, 0);
}

TEST_F(WatchCommand, ends_well_when_asked_to_and_keeps_others_out) {
  Process watcher(arguments());
  while (watcher.is_running() && !fs::exists(maps() / "map/dsm.vrt")) ::usleep(20'000);
  const Outcome second = skysweep(arguments());
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_TRUE(says(second.err, {"maps", "is being written by process"})) << second.err;
  watcher.interrupt();
  const Outcome ended = watcher.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(once().exit_code, 0);
  EXPECT_EQ(status().at("mapped"), kPhotographs);
}

TEST_F(WatchCommand, wrong_values_are_refused_in_the_first_second) {
  struct Case {
    Arguments more;
    std::vector<std::string> words;
  };
  const std::vector<Case> cases = {{{"--group=color"}, {"--group", "color"}},
                                   {{"--group-gap=5"}, {"gap", "time or distance"}},
                                   {{"--group=time", "--group-gap=0"}, {"gap", "positive"}},
                                   {{"--first=1"}, {"fewer than 2"}},
                                   {{"--poll=0"}, {"polling", "0.05"}},
                                   {{"--metrics=0"}, {"--metrics"}},
                                   {{"--metrics=70000"}, {"--metrics"}},
                                   {{"--settings=missing.toml"}, {"missing.toml"}},
                                   {{"--poses=" + images().string()}, {"--poses", "folder"}},
                                   {{"--crs=EPSG:nonsense"}, {"EPSG:nonsense"}},
                                   {{"--preset=fastest"}, {"fastest"}}};
  for (const Case& c : cases) {
    const Outcome outcome = skysweep(arguments(c.more));
    EXPECT_EQ(outcome.exit_code, 2) << c.more.front();
    EXPECT_TRUE(says(outcome.err, c.words)) << outcome.err;
  }
  EXPECT_EQ(skysweep({"watch", folder / "missing", "-o", maps()}).exit_code, 2);
  EXPECT_EQ(skysweep({"watch", images(), "-o", images() / "maps"}).exit_code, 2);
}

TEST_F(WatchCommand, a_full_disk_is_said_and_nothing_is_lost) {
  Process on_full_disk(arguments({"--once"}), 8000);
  const Outcome outcome = on_full_disk.wait();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_TRUE(says(outcome.err, {"cannot"})) << outcome.err;
  ASSERT_EQ(once().exit_code, 0);
  expect_map(maps() / "map", kPhotographs);
}

TEST_F(WatchCommand, a_project_that_was_made_with_other_settings_is_named) {
  ASSERT_EQ(once().exit_code, 0);
  Arguments other = arguments({"--once"});
  std::replace(other.begin(), other.end(), std::string("--cell=0.1"), std::string("--cell=0.2"));
  const Outcome outcome = skysweep(other);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(says(outcome.err, {"cell", "0.1", "0.2"})) << outcome.err;
}

}  // namespace
}  // namespace skysweep::app_test
