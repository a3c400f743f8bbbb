// SPDX-License-Identifier: Apache-2.0
// A thin lens that is not focused on the ground: points become discs.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(Defocus& settings);

// Diameter, in pixels, of the disc that a point at `distance_m` becomes.
double blur_disc_px(const Defocus& settings, double focal_px, double distance_m);

class DefocusEffect final : public RayEffect {
 public:
  DefocusEffect(const Defocus& settings, const Scene& scene, const std::vector<Shot>& shots);
  int rounds() const override { return rounds_; }
  void bend(SampleBatch& batch) const override;

 private:
  double radius_m_, per_focus_distance_;
  int rounds_;
};

}  // namespace skysweep::scene
