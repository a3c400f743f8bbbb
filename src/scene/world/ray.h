// SPDX-License-Identifier: Apache-2.0
// A ray, in the scene's frame.
#pragma once

#include "core/vec.h"

namespace skysweep::scene {

struct Ray {
  Vec3d origin;
  Vec3d direction;  // of any length but zero
};

constexpr int kRayBatch = 16;  // rays that are traced together

}  // namespace skysweep::scene
