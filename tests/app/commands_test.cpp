// SPDX-License-Identifier: Apache-2.0
// The commands around `run`.
#include <cmath>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

class Commands : public SimulatedFlight {
 protected:
  void make_project() { ASSERT_EQ(run().exit_code, 0); }

  // Name of a level-0 tile with heights.
  std::string a_tile() const {
    for (const auto& entry : fs::recursive_directory_iterator(project() / "tiles" / "dem" / "l0"))
      if (entry.path().extension() == ".tif")
        return "l0" + entry.path().parent_path().filename().string() + entry.path().stem().string();
    return "none";
  }
};

TEST_F(Commands, version_and_help_end_with_0) {
  const Outcome version = skysweep({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(says(version.out, {"skysweep "}));
  for (const char* command : {"run", "info", "evaluate", "sweep", "simulate", "export"}) {
    const Outcome help = skysweep({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_TRUE(says(help.out, {"--help"}));
  }
}

TEST_F(Commands, no_command_and_unknown_command_are_usage_errors) {
  EXPECT_EQ(skysweep({}).exit_code, 2);
  const Outcome unknown = skysweep({"fly"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err, "");
}

TEST_F(Commands, info_tells_of_a_project) {
  put_bytes(photo("0002.jpg"), "");
  make_project();
  const Outcome outcome = skysweep({"info", project()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, {"local metric frame", "cells of 0.1 m, tiles of 64 x 64 cells", "5 of 6 used",
                                 "refused", "0002.jpg", "is empty"}));
}

TEST_F(Commands, info_explains_which_photographs_serve_a_tile) {
  make_project();
  const Outcome outcome = skysweep({"info", project(), "--tile", a_tile()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, {a_tile(), "of its cells have a height", "used", ".jpg", "degrees from nadir", "GSD"}));
  const Outcome malformed = skysweep({"info", project(), "--tile", "somewhere"});
  EXPECT_EQ(malformed.exit_code, 2);
  EXPECT_TRUE(says(malformed.err, {"somewhere", "l0x-7y4"}));
}

TEST_F(Commands, info_lists_poses) {
  const Outcome outcome = skysweep({"info", poses()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, {"6 photographs with poses, 0 refused", "0001.jpg", "0006.jpg", "320 x 240", "f 310"}));
  EXPECT_EQ(skysweep({"info", folder / "nothing"}).exit_code, 3);
}

TEST_F(Commands, sweep_writes_every_stage_of_a_tile) {
  make_project();
  const Outcome outcome = skysweep({"sweep", project(), "--tile", a_tile(), "--dump", folder / "stages"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* stage : {"coarse", "plane", "cost", "mean_cost", "fraction", "bend", "height", "sigma", "color",
                            "color_view", "view_count"})
    EXPECT_TRUE(fs::exists(folder / "stages" / (std::string(stage) + ".tif"))) << stage;
  EXPECT_TRUE(says(file_bytes(folder / "stages/views.txt"), {".jpg"}));
  EXPECT_TRUE(says(file_bytes(folder / "stages/selection.txt"), {"heights found by the coarse sweep", "used"}));

  // Inside its collar the dumped height is the tile's.
  const std::string tile = a_tile();
  const std::size_t x = tile.find('x'), y = tile.find('y');
  const Array2d<float> stored =
      heights_in(project() / "tiles/dem/l0" / tile.substr(x, y - x) / (tile.substr(y) + ".tif"));
  const Array2d<float> dumped = heights_in(folder / "stages/height.tif");
  ASSERT_EQ(dumped.width(), stored.width() + 32);
  for (int row = 0; row < stored.height(); ++row)
    for (int column = 0; column < stored.width(); ++column) {
      const float a = stored(column, row), b = dumped(column + 16, row + 16);
      ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << column << ", " << row;
    }
}

TEST_F(Commands, sweep_needs_a_project) {
  const Outcome outcome = skysweep({"sweep", images(), "--tile", "l0x0y0", "--dump", folder / "stages"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(says(outcome.err, {"holds no project"}));
}

TEST_F(Commands, evaluate_measures_against_the_truth) {
  make_project();
  const Outcome outcome = skysweep({"evaluate", "--dsm", project() / "dsm.tif", "--truth", truth(), "--gsd", "0.05",
                                    "--json", folder / "accuracy.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, {"NMAD", "with a height", "within 1 GSD"}));
  const nlohmann::json accuracy = nlohmann::json::parse(file_bytes(folder / "accuracy.json"));
  const nlohmann::json& overall = accuracy.at("overall");
  EXPECT_GT(overall.at("valid_share").get<double>(), 0.9) << accuracy.dump(1);
  EXPECT_LT(overall.at("median_absolute_m").get<double>(), 0.1) << accuracy.dump(1);
}

TEST_F(Commands, evaluate_needs_one_truth) {
  EXPECT_EQ(skysweep({"evaluate", "--dsm", truth(), "--gsd", "0.05"}).exit_code, 2);
  EXPECT_EQ(skysweep({"evaluate", "--dsm", truth(), "--truth", truth(), "--gsd", "0"}).exit_code, 2);
  EXPECT_EQ(skysweep({"evaluate", "--dsm", folder / "none.tif", "--truth", truth(), "--gsd", "0.05"}).exit_code, 3);
}

TEST_F(Commands, simulate_refuses_a_scene_with_an_unknown_key) {
  put_bytes(folder / "scene.toml", "[camera]\nwidth_px = 320\nheight_px = 240\nfocal_px = 310\nzoom = 2\n");
  const Outcome outcome = skysweep({"simulate", folder / "scene.toml", "-o", folder / "simulated"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(says(outcome.err, {"scene.toml", "zoom"}));
  EXPECT_FALSE(fs::exists(folder / "simulated"));
}

// One photograph of bare ground, and whatever else the scene shall have.
std::string tiny_scene(const std::string& more) {
  return "area_m = [4, 3]\n[camera]\nwidth_px = 64\nheight_px = 48\nfocal_px = 60\n"
         "[flight]\nbeyond_area_m = -2\n[truth]\ntie_points = 0\n" +
         more;
}

TEST_F(Commands, simulate_explains_which_effects_ran_and_why) {
  put_bytes(folder / "scene.toml", tiny_scene("[effects.haze]\nvisibility_m = 900\n"));
  const Outcome plain = skysweep({"simulate", folder / "scene.toml", "-o", folder / "simulated"});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(plain.out.find("haze"), std::string::npos);
  const Outcome explained = skysweep({"simulate", folder / "scene.toml", "-o", folder / "simulated", "--explain"});
  EXPECT_EQ(explained.exit_code, 0) << explained.err;
  const auto line_of = [&](const std::string& effect) {
    const std::size_t begin = explained.out.find("  " + effect + " ");
    return begin == std::string::npos ? "" : explained.out.substr(begin, explained.out.find('\n', begin) - begin);
  };
  EXPECT_TRUE(says(line_of("haze"), {"air", " 48 ", "scene.toml:10: effects.haze"}));  // a call for each row
  EXPECT_TRUE(says(line_of("vignetting"), {"image", " - ", "not named: nothing runs"}));
  EXPECT_TRUE(says(explained.out, {"4 rays a pixel"}));
}

TEST_F(Commands, simulate_tells_the_time_left_from_the_first_photograph_on) {
  put_bytes(folder / "scene.toml", tiny_scene(""));
  const Outcome outcome = skysweep({"simulate", folder / "scene.toml", "-o", folder / "simulated"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t first = outcome.out.find("photographs and truth 1/2, ");
  ASSERT_NE(first, std::string::npos) << outcome.out;
  // A clock that is started after the first photograph gives absurd rates: photographs take more than 0.1 ms.
  EXPECT_LT(std::stod(outcome.out.substr(first + 27)), 1e4) << outcome.out;
}

}  // namespace
}  // namespace skysweep::app_test
