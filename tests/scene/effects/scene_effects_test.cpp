// SPDX-License-Identifier: Apache-2.0
// Whole simulations with effects: who is called, what stays true, the same bytes for any number of threads.
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "raster/geotiff.h"
#include "raster/photo.h"
#include "scene/effects/catalogue.h"
#include "scene/effects/small_flight.h"
#include "scene/simulate.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

// Streets, flooded ankle-deep.
const std::string kTown =
    "area_m = [16, 4]\n[town]\nblock_m = 8\nstreet_m = 12\nmax_height_m = 4.5\n[terrain]\nwater_level_m = 0.1\n";

// All effects there are, with their tables.
const std::vector<std::pair<std::string, std::string>> kTables = {
    {"pose_error", "position_sigma_m = 0.2\nangle_drift_deg = 0.2"},
    {"time_jitter", "sigma_s = 0.02"},
    {"rolling_shutter", "readout_s = 0.03"},
    {"motion_blur", "exposure_s = 0.02"},
    {"defocus", "aperture_mm = 20\nfocus_distance_m = 4"},
    {"chromatic_aberration", "red_px = 1"},
    {"sky", "strength = 1.5"},
    {"sun_movement", "hours = 1"},
    {"cloud_shadows", "cover = 0.5\nsize_m = 2"},
    {"moving_cars", "per_100m = 10"},
    {"specular_water", "wind_mps = 3"},
    {"haze", "visibility_m = 50"},
    {"vignetting", "strength = 1"},
    {"exposure_drift", "stops = 0.3"},
    {"sensor_noise", "iso = 800"}};

std::string table_of(std::size_t i) { return "[effects." + kTables[i].first + "]\n" + kTables[i].second + "\n"; }

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("scene_effects_" + name);
  fs::remove_all(folder);
  return folder;
}

std::string bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) out.push_back(fs::relative(entry.path(), folder).string());
  std::sort(out.begin(), out.end());
  return out;
}

Simulation simulate_into(const fs::path& folder, const std::string& text) {
  SerialExecutor executor;
  return simulate(level_scene(text), folder, executor);
}

std::array<long long, kEffects> calls() {
  std::array<long long, kEffects> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = calls_since_start(static_cast<EffectId>(i));
  return out;
}

TEST(SceneEffects, a_scene_that_names_none_calls_none) {
  const auto before = calls();
  const Simulation result = simulate_into(fresh_folder("none"), kTown);
  EXPECT_EQ(calls(), before);
  EXPECT_EQ(result.effects.size(), kTables.size());
  for (const EffectReport& line : result.effects) {
    EXPECT_EQ(line.named_at, "");
    EXPECT_EQ(line.calls, 0);
  }
}

// Each effect alone: it runs, no other does, and it changes what it is for and nothing else.
TEST(SceneEffects, a_scene_that_names_one_calls_that_one_and_no_other) {
  const fs::path plain = fresh_folder("plain");
  simulate_into(plain, kTown);
  ASSERT_EQ(kTables.size(), static_cast<std::size_t>(kEffects));
  for (std::size_t effect = 0; effect < kTables.size(); ++effect) {
    const std::string& name = kTables[effect].first;
    SCOPED_TRACE(name);
    const fs::path folder = fresh_folder(name);
    const auto before = calls();
    const Simulation result = simulate_into(folder, kTown + table_of(effect));
    const auto after = calls();
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(result.effects[i].name, kTables[i].first);
      EXPECT_EQ(after[i] > before[i], i == effect) << kTables[i].first;
      EXPECT_EQ(result.effects[i].calls, after[i] - before[i]) << kTables[i].first;
      EXPECT_EQ(result.effects[i].named_at.empty(), i != effect) << kTables[i].first;
    }
    const bool metadata = result.effects[effect].stage == "metadata";
    int changed = 0;
    for (const std::string& photo : raster::list_photos(plain / "images"))
      changed += bytes(folder / "images" / photo) != bytes(plain / "images" / photo);
    EXPECT_EQ(changed == 0, metadata);
    EXPECT_EQ(bytes(folder / "poses.csv") == bytes(plain / "poses.csv"), !metadata);
    EXPECT_EQ(fs::exists(folder / "truth/poses.csv"), metadata);
    if (metadata) {
      EXPECT_EQ(bytes(folder / "truth/poses.csv"), bytes(plain / "poses.csv"));
    }
    const auto ortho = [](const fs::path& of) { return raster::read_color_raster(of / "truth/ortho.tif").values; };
    EXPECT_EQ(ortho(folder) == ortho(plain), name != "sky");
    EXPECT_EQ(raster::read_float_raster(folder / "truth/dsm.tif").values,
              raster::read_float_raster(plain / "truth/dsm.tif").values);
  }
}

TEST(SceneEffects, all_together_give_the_same_bytes_for_one_and_two_threads) {
  std::string text = kTown;
  for (std::size_t i = 0; i < kTables.size(); ++i) text += table_of(i);
  const fs::path a = fresh_folder("serial"), b = fresh_folder("two");
  SerialExecutor serial;
  ThreadExecutor two(2);
  simulate(level_scene(text), a, serial);
  simulate(level_scene(text), b, two);
  const std::vector<std::string> files = files_below(a);
  EXPECT_EQ(files, files_below(b));
  for (const std::string& file : files) EXPECT_EQ(bytes(a / file), bytes(b / file)) << file;
}

TEST(SceneEffects, unknown_effects_and_keys_are_refused) {
  EXPECT_TRUE(refused("[effects.fog]\ndensity = 1\n", "fog"));
  EXPECT_TRUE(refused("[effects.haze]\nvisibility_m = 9\nvisbility = 3\n", "visbility"));
}

}  // namespace
}  // namespace skysweep::scene
