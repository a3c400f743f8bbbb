// SPDX-License-Identifier: Apache-2.0
// Poses as a navigation unit would have them: white errors and errors that drift over the flight. Metadata only.
#pragma once

#include "scene/effects/dials.h"
#include "scene/effects/effect.h"
#include "scene/scene.h"

namespace skysweep::scene {

std::vector<Dial> dials(PoseError& settings);

class PoseErrorEffect final : public MetadataEffect {
 public:
  // Throws Error(usage) if all errors are zero.
  PoseErrorEffect(const PoseError& settings, const Scene& scene, const std::vector<Shot>& shots);
  void spoil(const std::vector<Shot>& shots, std::vector<formats::PosedImage>& images) const override;

 private:
  PoseError settings_;
  std::uint64_t seed_;
};

// Rotation by |turn| radians about the axis `turn` (Rodrigues).
Mat3d rotation_about(Vec3d turn);

}  // namespace skysweep::scene
