// SPDX-License-Identifier: Apache-2.0
#include "scene/ray_throughput.h"

#include <vector>

#include "core/check.h"
#include "scene/flight_plan.h"
#include "scene/render/pixel_rays.h"
#include "scene/world/world.h"

namespace skysweep::scene {

struct RayThroughput::View {
  World world;
  bool shadows;
  std::vector<Ray> rays;

  explicit View(const Scene& scene)
      : world(scene, visible_ground(scene, plan_flight(scene))), shadows(scene.light.shadows) {
    const camera::Pose pose = plan_flight(scene).front();
    const PixelRays pixels(scene.camera);
    const Mat3d world_from_cam = transpose(pose.cam_from_world);
    for (int row = 0; row < scene.camera.height_px; ++row)
      for (int column = 0; column < scene.camera.width_px; ++column)
        rays.push_back({pose.center, world_from_cam * pixels.direction(column, row, {0.5, 0.5})});
    SKY_CHECK_EQ(rays.size() % Tracer::kBatch, 0u);
  }
};

RayThroughput::RayThroughput(const Scene& scene) : view_(std::make_unique<View>(scene)) {}
RayThroughput::~RayThroughput() = default;

int RayThroughput::rays() const { return static_cast<int>(view_->rays.size()); }

std::function<int()> RayThroughput::embree_alone() const { return view_->world.tracer().embree_alone(view_->rays); }

int RayThroughput::exact_hits() const {
  int found = 0;
  for (std::size_t i = 0; i < view_->rays.size(); i += Tracer::kBatch) {
    SurfacePoint hits[Tracer::kBatch];
    view_->world.tracer().first_hits(view_->rays.data() + i, Tracer::kBatch, hits);
    for (const SurfacePoint& hit : hits) found += hit.face != Face::none;
  }
  return found;
}

RayThroughput::Light RayThroughput::light() const {
  Light out;
  double sum = 0;
  for (std::size_t i = 0; i < view_->rays.size(); i += Tracer::kBatch) {
    SurfacePoint hits[Tracer::kBatch];
    LinearRgb light[Tracer::kBatch];
    view_->world.look(view_->rays.data() + i, Tracer::kBatch, hits, light);
    for (int k = 0; k < Tracer::kBatch; ++k) {
      sum += light[k].g;
      out.shadow_rays += view_->shadows && dot(hits[k].normal, view_->world.moment().towards_sun) > 0;
    }
  }
  out.mean_green = sum / rays();
  return out;
}

}  // namespace skysweep::scene
