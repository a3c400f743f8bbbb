// SPDX-License-Identifier: Apache-2.0
// Throughput of the renderer of synthetic scenes on one core, in rays a second, beside Embree alone with the very same
// rays in the same run: packets prepared, nothing worked out from the hits. Counted are the rays from the camera;
// shadow rays, of which there is one for most of them, are counted where a bench says so. Each bench checks its result.
// Run: build/release/bench/scene_bench
#include <benchmark/benchmark.h>

#include <cmath>

#include "camera/pose.h"
#include "scene/flight_plan.h"
#include "scene/render/pixel_rays.h"
#include "scene/world/world.h"

namespace {

using namespace skysweep;
using namespace skysweep::scene;

Scene town(double contrast, bool shadows) {
  Scene scene;
  scene.seed = 7;
  scene.area_m = {120, 90};
  scene.terrain = {2.5, 70};
  scene.town.emplace();
  scene.texture.contrast = contrast;
  scene.light.shadows = shadows;
  scene.camera = camera::camera_from_sensor(12, 12, 1000, 750);
  scene.flight.beyond_area_m = -30;
  return scene;
}

// A photograph of the middle of the town, ready to be traced: the rays of each pixel's centre.
struct View {
  World world;
  std::vector<Ray> rays;

  explicit View(const Scene& scene) : world(scene, visible_ground(scene, plan_flight(scene))) {
    const camera::Pose pose = plan_flight(scene).front();
    const PixelRays pixels(scene.camera);
    const Mat3d world_from_cam = transpose(pose.cam_from_world);
    for (int row = 0; row < scene.camera.height_px; ++row)
      for (int column = 0; column < scene.camera.width_px; ++column)
        rays.push_back({pose.center, world_from_cam * pixels.direction(column, row, {0.5, 0.5})});
  }
};

const View& view(bool textured, bool shadows) {
  static const View views[] = {View(town(0, false)), View(town(0, true)), View(town(1, false)), View(town(1, true))};
  return views[2 * textured + shadows];
}

void set_rate(benchmark::State& state, std::size_t rays) {
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays) * static_cast<double>(state.iterations()),
                                                benchmark::Counter::kIsRate);
}

void embree_alone(benchmark::State& state) {
  const View& v = view(false, false);
  const auto trace = v.world.tracer().embree_alone(v.rays);
  int hits = 0;
  for (auto _ : state) hits = trace();
  if (hits != static_cast<int>(v.rays.size())) state.SkipWithError("rays have missed the ground");
  set_rate(state, v.rays.size());
}
BENCHMARK(embree_alone)->Unit(benchmark::kMillisecond);

// Where the rays hit, worked out in double.
void exact_hits(benchmark::State& state) {
  const View& v = view(false, false);
  int missed = 0;
  for (auto _ : state)
    for (std::size_t i = 0; i + Tracer::kBatch <= v.rays.size(); i += Tracer::kBatch) {
      SurfacePoint hits[Tracer::kBatch];
      v.world.tracer().first_hits(v.rays.data() + i, Tracer::kBatch, hits);
      missed += hits[0].face == Face::none;
    }
  if (missed > 0) state.SkipWithError("rays have missed the ground");
  set_rate(state, v.rays.size());
}
BENCHMARK(exact_hits)->Unit(benchmark::kMillisecond);

// The light that comes back: everything a photograph needs but its encoding. With shadows each ray from the camera
// whose surface faces the sun sends a second one, which is counted.
void light(benchmark::State& state, bool textured, bool shadows) {
  const View& v = view(textured, shadows);
  double sum = 0;
  std::size_t facing = 0;
  for (auto _ : state) {
    sum = 0;
    facing = 0;
    for (std::size_t i = 0; i + Tracer::kBatch <= v.rays.size(); i += Tracer::kBatch) {
      SurfacePoint hits[Tracer::kBatch];
      LinearRgb light[Tracer::kBatch];
      v.world.look(v.rays.data() + i, Tracer::kBatch, hits, light);
      for (int k = 0; k < Tracer::kBatch; ++k) {
        sum += light[k].g;
        facing += shadows && dot(hits[k].normal, v.world.moment().towards_sun) > 0;
      }
    }
  }
  const double mean = sum / static_cast<double>(v.rays.size());
  if (!(mean > 0.02 && mean < 1)) state.SkipWithError("the town is not lit as it should be");
  set_rate(state, v.rays.size() + facing);
}
BENCHMARK_CAPTURE(light, plain, false, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(light, plain_with_shadows, false, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(light, textured, true, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(light, textured_with_shadows, true, true)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
