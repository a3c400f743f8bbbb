// SPDX-License-Identifier: Apache-2.0
// Throughput of the renderer of synthetic scenes on one core, in rays a second, beside Embree alone with the very same
// rays in the same run: packets prepared, nothing worked out from the hits. Counted are the rays from the camera;
// shadow rays, of which there is one for most of them, are counted where a bench says so. Each bench checks its result.
// Run: build/release/bench/scene_bench
#include <benchmark/benchmark.h>

#include "scene/ray_throughput.h"

namespace {

using namespace skysweep;
using namespace skysweep::scene;

Scene town(bool textured, bool shadows) {
  Scene scene;
  scene.seed = 7;
  scene.area_m = {120, 90};
  scene.terrain = {2.5, 70};
  scene.town.emplace();
  if (!textured) scene.texture.ground = GroundTexture::none;
  scene.light.shadows = shadows;
  scene.camera = camera::camera_from_sensor(12, 12, 1000, 750);
  scene.flight.beyond_area_m = -30;
  return scene;
}

// A photograph of the middle of the town.
const RayThroughput& view(bool textured, bool shadows) {
  static const RayThroughput views[] = {RayThroughput(town(false, false)), RayThroughput(town(false, true)),
                                        RayThroughput(town(true, false)), RayThroughput(town(true, true))};
  return views[2 * textured + shadows];
}

void set_rate(benchmark::State& state, int rays) {
  state.counters["rays/s"] =
      benchmark::Counter(rays * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void embree_alone(benchmark::State& state) {
  const RayThroughput& v = view(false, false);
  const auto trace = v.embree_alone();
  int hits = 0;
  for (auto _ : state) hits = trace();
  if (hits != v.rays()) state.SkipWithError("rays have missed the ground");
  set_rate(state, v.rays());
}
BENCHMARK(embree_alone)->Unit(benchmark::kMillisecond);

// Where the rays hit, worked out in double.
void exact_hits(benchmark::State& state) {
  const RayThroughput& v = view(false, false);
  int hits = 0;
  for (auto _ : state) hits = v.exact_hits();
  if (hits != v.rays()) state.SkipWithError("rays have missed the ground");
  set_rate(state, v.rays());
}
BENCHMARK(exact_hits)->Unit(benchmark::kMillisecond);

// The light that comes back: everything a photograph needs but its encoding. With shadows each ray from the camera
// whose surface faces the sun sends a second one, which is counted.
void light(benchmark::State& state, bool textured, bool shadows) {
  const RayThroughput& v = view(textured, shadows);
  RayThroughput::Light seen;
  for (auto _ : state) seen = v.light();
  if (!(seen.mean_green > 0.02 && seen.mean_green < 1)) state.SkipWithError("the town is not lit as it should be");
  set_rate(state, v.rays() + seen.shadow_rays);
}
BENCHMARK_CAPTURE(light, plain, false, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(light, plain_with_shadows, false, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(light, textured, true, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(light, textured_with_shadows, true, true)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
