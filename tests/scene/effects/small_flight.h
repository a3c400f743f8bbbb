// SPDX-License-Identifier: Apache-2.0
// A flight of three photographs over a small level scene, the last from where the first was taken, and pictures of it
// through the effects that the scene names.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/effects/scene_effects.h"
#include "scene/render/photograph.h"
#include "scene/scene_file.h"

namespace skysweep::scene {

constexpr double kPicture_gsd_m = 0.1;
constexpr double kAltitude_m = 6;
constexpr double kFlight_s = 0.2;  // at the 8 m/s that a scene has by default

// 64 x 48 pixels of 0.1 m, seen from 6 m above (3.2, 2.4), top to the north. `text`: more of the scene file.
inline Scene level_scene(const std::string& text = "") {
  return parse_scene(text +
                         "\n[camera]\nwidth_px = 64\nheight_px = 48\nfocal_px = 60\n[flight]\ngsd_m = "
                         "0.1\nalong_overlap = 0.5\nacross_overlap = 0.5\n"
                         "[photographs]\nformat = \"png\"\n",
                     "s.toml");
}

inline std::vector<camera::Pose> north_and_back() {
  const Mat3d down{{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  return {{down, {3.2, 2.4, kAltitude_m}}, {down, {3.2, 3.2, kAltitude_m}}, {down, {3.2, 2.4, kAltitude_m}}};
}

// Scene, world and effects of one flight.
struct SmallFlight {
  explicit SmallFlight(const Scene& its_scene, std::vector<camera::Pose> its_poses = north_and_back())
      : scene(its_scene),
        poses(std::move(its_poses)),
        effects(make_effects(scene, poses)),
        world(scene, {{-20, -20}, {26, 25}}) {
    if (effects) effects->change_world(world);
  }

  Array2d<Rgb8> photograph(std::size_t index = 0) const {
    SerialExecutor executor;
    const auto changes = effects ? effects->photograph(index, world) : nullptr;
    return take_photograph(world, scene.camera, PixelRays(scene.camera), poses[index], {}, executor, changes.get());
  }

  Scene scene;
  std::vector<camera::Pose> poses;
  std::unique_ptr<SceneEffects> effects;
  World world;
};

inline Array2d<Rgb8> picture_of(const std::string& scene) { return SmallFlight(level_scene(scene)).photograph(); }

// Linear light of a grey level (IEC 61966-2-1).
inline double light_of(std::uint8_t level) {
  const double v = level / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// The sentence with which a scene is refused.
inline std::string refusal_of(const std::string& text) {
  try {
    SmallFlight flight(level_scene(text));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "accepted";
}

inline bool refused(const std::string& text, const std::string& because) {
  const std::string sentence = refusal_of(text);
  EXPECT_NE(sentence.find(because), std::string::npos) << sentence;
  return sentence != "accepted";
}

}  // namespace skysweep::scene
