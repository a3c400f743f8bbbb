// SPDX-License-Identifier: Apache-2.0
// Disks that are full, read-only or gone, clocks that run backwards, names that mean something to a shell: each ends
// with a sentence, and with nothing lost.
#include <sys/mount.h>

#include <chrono>
#include <thread>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using std::chrono_literals::operator""h;
using std::chrono_literals::operator""ms;
using testing_support::file_bytes;
using testing_support::put_bytes;

// A small disk of its own; needs the right to mount.
class SmallDisk {
 public:
  SmallDisk(fs::path place, const std::string& size) : place_(std::move(place)) {
    fs::create_directories(place_);
    mounted_ = ::mount("tmpfs", place_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }
  bool make_read_only() const {
    return ::mount(nullptr, place_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }
  bool make_writable() const { return ::mount(nullptr, place_.c_str(), nullptr, MS_REMOUNT, nullptr) == 0; }

 private:
  fs::path place_;
  bool mounted_ = false;
};

class HardConditions : public SimulatedFlight {
 protected:
  std::map<std::string, std::string> undisturbed() const {
    EXPECT_EQ(run({"--dz=0.02"}, "undisturbed").exit_code, 0);
    return rasters_in(project("undisturbed"));
  }

  // The next run makes the map complete.
  void expect_completed(const std::map<std::string, std::string>& expected, const std::string& name) const {
    const Outcome outcome = run({"--dz=0.02"}, name);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(rasters_in(project(name)) == expected);
  }
};

TEST_F(HardConditions, disk_that_is_too_small_is_said_before_anything_is_written) {
  const SmallDisk disk(project("disk"), "600k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a file system";
  const Outcome outcome = run({}, "disk/map");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(says(outcome.err, {"MiB free, and this run may need", "--cell", "--aoi"}));
  EXPECT_FALSE(fs::exists(project("disk") / "map" / "project.toml"));
}

TEST_F(HardConditions, disk_that_somebody_else_fills_meanwhile_costs_only_the_tiles_in_work) {
  const auto expected = undisturbed();
  const SmallDisk disk(project("disk"), "30m");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a file system";
  const fs::path map = project("disk") / "map", ballast = project("disk") / "ballast";
  Process process(run_arguments({"--dz=0.02", "--threads=1"}, "disk/map"));
  while (process.is_running() && !fs::exists(map / "tiles" / "dem")) std::this_thread::sleep_for(1ms);
  put_bytes(ballast, std::string(std::size_t{40} << 20, 'x'));  // as much of it as fits
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(says(outcome.err, {"skysweep: cannot write ", map.string()}));
  for (const auto& [name, bytes] : rasters_in(map)) {
    EXPECT_TRUE(name.find("/l0/") == std::string::npos || bytes == expected.at(name)) << name << " is not whole";
  }
  const Outcome still_full = run({"--dz=0.02"}, "disk/map");
  EXPECT_EQ(still_full.exit_code, 1);
  fs::remove(ballast);
  expect_completed(expected, "disk/map");
}

TEST_F(HardConditions, read_only_project_is_said_and_can_still_be_looked_at) {
  const auto expected = undisturbed();
  const SmallDisk disk(project("disk"), "30m");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a file system";
  expect_completed(expected, "disk/map");
  ASSERT_TRUE(disk.make_read_only());
  fs::rename(photo("0004.jpg"), folder / "0004.jpg");
  const Outcome outcome = run({"--dz=0.02"}, "disk/map");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(says(outcome.err, {(project("disk") / "map").string(), "Read-only file system", "-o"}));
  EXPECT_TRUE(rasters_in(project("disk") / "map") == expected);
  EXPECT_TRUE(says(skysweep({"info", project("disk") / "map"}).out, {"6 of 6 used"}));
  EXPECT_EQ(run({"--dz=0.02", "--dry-run"}, "disk/map").exit_code, 0);
  const Outcome elsewhere = run({}, "disk/new");
  EXPECT_EQ(elsewhere.exit_code, 1);
  EXPECT_TRUE(says(elsewhere.err, {"Read-only file system"}));
  ASSERT_TRUE(disk.make_writable());
  fs::rename(folder / "0004.jpg", photo("0004.jpg"));
  expect_completed(expected, "disk/map");
}

TEST_F(HardConditions, image_folder_that_is_gone_or_empty_leaves_the_map_as_it_was) {
  const auto expected = undisturbed();
  expect_completed(expected, "project");
  const std::string catalogue = file_bytes(project() / "catalog.gpkg");
  fs::rename(images(), folder / "unplugged");
  Outcome outcome = run({"--dz=0.02"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(says(outcome.err, {images().string(), "does not exist"}));
  fs::create_directories(images());  // a mount point without its disk
  outcome = run({"--dz=0.02"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(says(outcome.err, {"no photographs in", images().string()}));
  EXPECT_TRUE(rasters_in(project()) == expected);
  EXPECT_TRUE(file_bytes(project() / "catalog.gpkg") == catalogue);
  fs::remove(images());
  fs::rename(folder / "unplugged", images());
  expect_completed(expected, "project");
}

TEST_F(HardConditions, image_folder_that_vanishes_during_a_run_ends_it_and_loses_nothing) {
  const auto expected = undisturbed();
  Process process(run_arguments({"--dz=0.02", "--threads=1"}));
  while (process.is_running() && !fs::exists(project() / "tiles" / "dem")) std::this_thread::sleep_for(1ms);
  fs::rename(images(), folder / "unplugged");
  const Outcome outcome = process.wait();
  if (outcome.exit_code != 0) {  // else all photographs were in memory already
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(says(outcome.err, {"was there a moment ago and is gone", "left as it is"}));
  }
  fs::rename(folder / "unplugged", images());
  expect_completed(expected, "project");
  EXPECT_EQ(photographs_used(project()), kPhotographs);
}

TEST_F(HardConditions, clock_that_jumps_back_hides_no_change) {
  EXPECT_EQ(run({"--dz=0.02"}).exit_code, 0);
  // Another photograph of the same size, "older" than the map and than the one it replaces.
  std::string bytes = file_bytes(photo("0005.jpg"));
  bytes.resize(fs::file_size(photo("0002.jpg")), '\0');  // what follows the end of a JPEG is nobody's concern
  const auto time = fs::last_write_time(photo("0002.jpg"));
  put_bytes(photo("0002.jpg"), bytes);
  fs::last_write_time(photo("0002.jpg"), time - 24h);
  EXPECT_EQ(run({"--dz=0.02"}).exit_code, 0);
  EXPECT_GT(report_of(project()).at("tiles").at("computed"), 0);
  // Files of the future are no trouble either.
  for (const auto& entry : fs::recursive_directory_iterator(project()))
    if (entry.is_regular_file()) fs::last_write_time(entry.path(), fs::file_time_type::clock::now() + 24h);
  fs::last_write_time(photo("0001.jpg"), fs::file_time_type::clock::now() + 24h);
  EXPECT_EQ(run({"--dz=0.02"}).exit_code, 0);
  EXPECT_EQ(report_of(project()).at("tiles").at("computed"), 0);
}

TEST_F(HardConditions, names_with_spaces_quotes_umlauts_and_dots_are_names_like_others) {
  const auto expected = undisturbed();
  const std::vector<std::pair<std::string, std::string>> names = {{"0001.jpg", "1 first one.jpg"},
                                                                  {"0002.jpg", "2 o'neill's \"best\".jpg"},
                                                                  {"0003.jpg",
                                                                   "3 \xc3\x9c"
                                                                   "bersicht \xe6\x97\xa5\xe6\x9c\xac.jpg"},
                                                                  {"0004.jpg", "4 ..jpg"},
                                                                  {"0005.jpg", "5 ; rm -rf $HOME & `ls`.jpg"},
                                                                  {"0006.jpg", "6 -o.jpg"}};
  for (const auto& [plain, odd] : names) {
    fs::rename(photo(plain), photo(odd));
    std::string quoted;
    for (const char c : odd) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    replace_in_poses(plain, "\"" + quoted + "\"");
  }
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = run({"--dz=0.02"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
  EXPECT_EQ(photographs_used(project()), kPhotographs);
  EXPECT_EQ(report_of(project()).at("tiles").at("computed"), 0);
  EXPECT_TRUE(same_bits(heights_in(project() / "dsm.tif"), heights_in(project("undisturbed") / "dsm.tif")));
  EXPECT_EQ(run({"--dz=0.02", "--remove=5 ;*`ls`.jpg"}).exit_code, 0);
  EXPECT_EQ(photographs_used(project()), kPhotographs - 1);
}

TEST_F(HardConditions, line_break_in_a_name_breaks_no_line_of_ours) {
  fs::rename(photo("0003.jpg"), photo("a\nskysweep: all is well\x1b[2J.jpg"));
  const Outcome outcome = run({"--dz=0.02"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.err, {"a\\nskysweep: all is well\\x1b[2J.jpg"}));
  EXPECT_EQ(outcome.err.find("\nskysweep:"), std::string::npos);
  EXPECT_EQ(photographs_used(project()), kPhotographs - 1);
  EXPECT_TRUE(says(skysweep({"info", project()}).out, {"refused    a\\nskysweep"}));
}

TEST_F(HardConditions, names_that_lead_out_of_the_folder_are_no_way_out) {
  fs::rename(photo("0003.jpg"), folder / "0003.jpg");
  replace_in_poses("0003.jpg", "../0003.jpg");
  const Outcome outcome = run({"--dz=0.02"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.err, {"../0003.jpg"}));
  EXPECT_EQ(photographs_used(project()), kPhotographs - 1);
  // A path to the images or the project that goes through `..` is a path like others.
  Arguments arguments = run_arguments({"--dz=0.02"});
  arguments[1] = (images() / ".." / "images").string();
  arguments[4] = (project() / ".." / "project").string();
  EXPECT_EQ(skysweep(arguments).exit_code, 0);
  EXPECT_EQ(report_of(project()).at("tiles").at("computed"), 0);
}

}  // namespace
}  // namespace skysweep::app_test
