// SPDX-License-Identifier: Apache-2.0
// A run that is interrupted, or that the disk lets down, leaves whole files, and the next one completes the map.
#include <chrono>
#include <thread>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;

class DisturbedRun : public SimulatedFlight {
 protected:
  // Many tiles, one at a time, so that there is something to interrupt.
  Arguments slow_arguments(const std::string& project_name) const {
    return run_arguments({"--threads=1", "--dz=0.02"}, project_name);
  }

  std::map<std::string, std::string> undisturbed() const {
    EXPECT_EQ(skysweep(slow_arguments("undisturbed")).exit_code, 0);
    return rasters_in(project("undisturbed"));
  }

  void expect_whole_tiles(const std::map<std::string, std::string>& expected) const {
    for (const auto& [name, bytes] : rasters_in(project()))
      if (name.find("/l0/") != std::string::npos) {
        EXPECT_TRUE(bytes == expected.at(name)) << name << " is not whole";
      }
  }

  void expect_next_run_completes(const std::map<std::string, std::string>& expected) const {
    const Outcome next = skysweep(slow_arguments("project"));
    EXPECT_EQ(next.exit_code, 0) << next.err;
    EXPECT_TRUE(rasters_in(project()) == expected) << "the completed map differs from that of an undisturbed run";
    expect_map(project(), kPhotographs);
  }
};

TEST_F(DisturbedRun, full_disk_is_said_and_the_next_run_completes) {
  const auto expected = undisturbed();
  const std::uintmax_t catalogue_bytes = fs::file_size(project("undisturbed") / "catalog.gpkg");
  // Nothing fits; the catalogue fits in part; all but the largest files fit.
  for (const std::uintmax_t limit : {std::uintmax_t{1000}, std::uintmax_t{9000}, std::uintmax_t{20000},
                                     catalogue_bytes / 2, catalogue_bytes - 5000}) {
    SCOPED_TRACE("files of at most " + std::to_string(limit) + " bytes");
    fs::remove_all(project());
    const Outcome outcome = Process(slow_arguments("project"), limit).wait();
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, {"skysweep: ", project().string()}));
    expect_whole_tiles(expected);
    expect_next_run_completes(expected);
  }
}

TEST_F(DisturbedRun, interrupted_run_is_completed_by_the_next_one) {
  const auto expected = undisturbed();
  Process process(slow_arguments("project"));
  while (process.is_running() && !fs::exists(project() / "tiles" / "dem"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.interrupt();
  const Outcome outcome = process.wait();
  if (outcome.exit_code != 0) {  // else it was faster than the signal
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_TRUE(says(outcome.out, {"Interrupted. The same command goes on from here."}));
  }
  expect_whole_tiles(expected);
  expect_next_run_completes(expected);
}

}  // namespace
}  // namespace skysweep::app_test
