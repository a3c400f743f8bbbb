// SPDX-License-Identifier: Apache-2.0
// A lens that makes the red and the blue image a little larger or smaller than the green one.
#pragma once

#include <array>

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(ChromaticAberration& settings);

class ChromaticAberrationEffect final : public RayEffect {
 public:
  // Throws Error(usage) if both dials are zero.
  ChromaticAberrationEffect(const ChromaticAberration& settings, const Scene& scene, const std::vector<Shot>& shots);
  bool channels_apart() const override { return true; }
  void bend(SampleBatch& batch) const override;

 private:
  std::array<double, 3> shrink_;  // of the direction in which a pixel of a channel looks
};

}  // namespace skysweep::scene
