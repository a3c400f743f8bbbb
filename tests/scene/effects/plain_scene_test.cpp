// SPDX-License-Identifier: Apache-2.0
// A scene that names no effect: its photographs are those of the program before it had effects.
#include <gtest/gtest.h>

#include <cstdint>

#include "raster/photo.h"
#include "scene/simulate.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

// Level ground without buildings: every ray meets the plane in double, so that the bytes depend neither on Embree's
// instruction set nor on how a PNG is packed.
Scene plain_scene() {
  Scene scene;
  scene.area_m = {12, 9};
  scene.camera = camera::camera_from_sensor(10, 10, 120, 90);
  scene.flight.gsd_m = 0.1;
  scene.flight.along_overlap = 0.5;
  scene.flight.across_overlap = 0.5;
  scene.flight.beyond_area_m = -4;
  scene.photographs.format = PhotoFormat::png;
  return scene;
}

// FNV-1a of the pixels.
std::uint64_t hash_of(const Array2d<Rgb8>& photo) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const Rgb8 p : photo)
    for (const std::uint8_t v : {p.r, p.g, p.b}) hash = (hash ^ v) * 0x100000001b3ull;
  return hash;
}

TEST(PlainScene, photographs_without_effects_have_the_pixels_they_had_before_there_were_effects) {
  const fs::path folder = fs::path(testing::TempDir()) / "plain_scene";
  fs::remove_all(folder);
  SerialExecutor executor;
  simulate(plain_scene(), folder, executor);
  EXPECT_EQ(hash_of(raster::read_photo(folder / "images/0001.png")), 12595089589535570807ull);
  EXPECT_EQ(hash_of(raster::read_photo(folder / "images/0002.png")), 16068377370603630886ull);
  EXPECT_FALSE(fs::exists(folder / "truth/poses.csv"));
}

TEST(PlainScene, photographs_with_noise_and_gain_have_the_pixels_they_had_before_there_were_effects) {
  const fs::path folder = fs::path(testing::TempDir()) / "plain_noisy_scene";
  fs::remove_all(folder);
  SerialExecutor executor;
  Scene scene = plain_scene();
  scene.photographs.noise_sigma = 3;
  scene.photographs.gain_spread = 0.1;
  simulate(scene, folder, executor);
  EXPECT_EQ(hash_of(raster::read_photo(folder / "images/0001.png")), 3007909098156641093ull);
}

}  // namespace
}  // namespace skysweep::scene
