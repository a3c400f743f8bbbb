// SPDX-License-Identifier: Apache-2.0
// Time stamps that are a little wrong: a photograph gets the position where the aircraft was at another moment.
// Metadata only.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(TimeJitter& settings);

class TimeJitterEffect final : public MetadataEffect {
 public:
  // Throws Error(usage) if both dials are zero.
  TimeJitterEffect(const TimeJitter& settings, const Scene& scene, const std::vector<Shot>& shots);
  void spoil(const std::vector<Shot>& shots, std::vector<formats::PosedImage>& images) const override;

 private:
  TimeJitter settings_;
  std::uint64_t seed_;
};

}  // namespace skysweep::scene
