// SPDX-License-Identifier: Apache-2.0
// The effects of a scene, constructed: what simulate() and the reader of scene files know of them. A build that leaves
// the effects out (SKYSWEEP_EFFECTS=OFF) has left_out.cpp in the place of everything else in this folder.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "formats/pose_set.h"
#include "scene/render/photograph_effects.h"
#include "scene/scene.h"
#include "scene/world/world.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

class SceneEffects {
 public:
  virtual ~SceneEffects() = default;
  // What poses.csv and sparse/ say, given the truth in world coordinates.
  virtual std::vector<formats::PosedImage> recorded(std::vector<formats::PosedImage> truth) const = 0;
  virtual bool spoils_metadata() const = 0;
  // Light that the truth shows too.
  virtual void change_world(World& world) const = 0;
  // Of the photograph with this index; `world` must outlive it. Null if no effect touches photographs.
  virtual std::unique_ptr<PhotographEffects> photograph(std::size_t index, const World& world) const = 0;
  virtual int rays_per_pixel() const = 0;
  virtual std::vector<EffectReport> report() const = 0;
};

// Null if the scene names no effect. Throws Error(usage) if an effect cannot be had in this scene.
std::unique_ptr<SceneEffects> make_effects(const Scene& scene, const std::vector<camera::Pose>& poses);

// What --explain shows of a scene that names none.
std::vector<EffectReport> nothing_runs();

// The table [effects]. Throws Error(usage).
Effects read_effects(const settings::TomlTable& table);

// Its dials as read or by default; empty if none is named.
nlohmann::ordered_json effects_json(const Effects& effects);

}  // namespace skysweep::scene
