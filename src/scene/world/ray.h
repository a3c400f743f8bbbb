// SPDX-License-Identifier: Apache-2.0
// A ray, in the scene's frame.
#pragma once

#include <array>
#include <cstddef>

#include "core/vec.h"

namespace skysweep::scene {

struct Ray {
  Vec3d origin;
  Vec3d direction;  // of any length but zero
};

constexpr int kRayBatch = 16;  // rays that are traced together

// The rays of a batch, one coordinate of all of them after the other.
struct RayLanes {
  alignas(64) std::array<double, kRayBatch> ox, oy, oz, dx, dy, dz;

  // Lanes from `count` on repeat the first ray.
  RayLanes(const Ray* rays, int count) {
    for (int i = 0; i < kRayBatch; ++i) {
      const Ray& ray = rays[i < count ? i : 0];
      const auto at = static_cast<std::size_t>(i);
      ox[at] = ray.origin.x, oy[at] = ray.origin.y, oz[at] = ray.origin.z;
      dx[at] = ray.direction.x, dy[at] = ray.direction.y, dz[at] = ray.direction.z;
    }
  }
};

}  // namespace skysweep::scene
