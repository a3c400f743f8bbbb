// SPDX-License-Identifier: Apache-2.0
#include "scene/render/depth_image.h"

#include <algorithm>
#include <limits>

namespace skysweep::scene {

Array2d<float> depth_image(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                           const camera::Pose& pose, Executor& executor) {
  Array2d<float> depth(model.width_px, model.height_px, std::numeric_limits<float>::quiet_NaN());
  const Mat3d world_from_cam = transpose(pose.cam_from_world);
  executor.parallel_for(model.height_px, [&](int row) {
    Ray batch[Tracer::kBatch];
    SurfacePoint hits[Tracer::kBatch];
    for (int first = 0; first < model.width_px; first += Tracer::kBatch) {
      const int count = std::min(Tracer::kBatch, model.width_px - first);
      for (int i = 0; i < count; ++i) {
        const bool valid = rays.valid(first + i, row);
        const Vec3d in_camera = valid ? rays.direction(first + i, row, {0.5, 0.5}) : Vec3d{0, 0, 1};
        batch[i] = {pose.center, world_from_cam * in_camera};
      }
      world.tracer().first_hits(batch, count, hits);
      for (int i = 0; i < count; ++i)
        if (hits[i].face != Face::none && rays.valid(first + i, row))
          depth(first + i, row) = static_cast<float>(dot(pose.view_direction(), hits[i].position - pose.center));
    }
  });
  return depth;
}

}  // namespace skysweep::scene
