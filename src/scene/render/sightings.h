// SPDX-License-Identifier: Apache-2.0
// Which photographs see a point of a surface, and where in them.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "scene/world/world.h"

namespace skysweep::scene {

// Calls seen(index of the camera, pixel) for each camera, in their order, that shows the point, has it in front of its
// surface, and sees it past everything else. A sight ray starts a centimetre off the surface.
template <typename Seen>
void for_each_sighting(const World& world, const SurfacePoint& point, const std::vector<camera::Camera>& cameras,
                       Seen seen) {
  constexpr double kLiftOff_m = 0.01;
  Ray sight[Tracer::kBatch];
  std::size_t index[Tracer::kBatch];
  Vec2d at[Tracer::kBatch];
  bool active[Tracer::kBatch] = {}, hidden[Tracer::kBatch];
  int count = 0;
  const auto flush = [&] {
    world.tracer().blocked(sight, active, count, false, hidden);
    for (int i = 0; i < count; ++i)
      if (!hidden[i]) seen(index[i], at[i]);
    count = 0;
  };
  const Vec3d start = point.position + kLiftOff_m * point.normal;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Vec3d to_camera = cameras[i].pose().center - start;
    if (dot(to_camera, point.normal) <= 0) continue;
    const std::optional<Vec2d> pixel = cameras[i].project(point.position);
    if (!pixel || !cameras[i].shows(*pixel)) continue;
    sight[count] = {start, to_camera};
    index[count] = i;
    at[count] = *pixel;
    active[count] = true;
    if (++count == Tracer::kBatch) flush();
  }
  flush();
}

}  // namespace skysweep::scene
