// SPDX-License-Identifier: Apache-2.0
// What the hierarchy and the level-of-detail stop buy the ray caster: squares and elements looked at per ray, and rays
// a second on one core, for a town of 2048 x 2048 cells seen from far, from near and at a grazing angle, one ray a
// pixel of 320 x 180. Each bench checks its hits against those of the ray caster without the stop. Beside it Embree
// with the same heights as a grid (each patch two triangles), single rays as here; building its tree and our hierarchy
// are benches of their own.
//
// Run: build/release/bench/render_bench
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <cmath>

#include "core/random.h"
#include "render/ray_caster.h"
#include "render/view.h"

namespace {

using namespace skysweep;
using namespace skysweep::render;

constexpr int kCells = 2048;
constexpr double kCellM = 0.1;

// Hills, and houses of 6 to 20 m in every block of 24 m.
const RayCaster& town() {
  static const RayCaster caster = [] {
    Array2d<float> height(kCells, kCells);
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x)
        height(x, y) = static_cast<float>(2 * std::sin(x / 200.0) + 1.5 * std::cos(y / 170.0));
    Random random(7);
    for (int by = 40; by + 130 < kCells; by += 240)
      for (int bx = 40; bx + 130 < kCells; bx += 240) {
        const auto roof = static_cast<float>(random.uniform(6, 20));
        for (int y = by; y < by + 130; ++y)
          for (int x = bx; x < bx + 130; ++x) height(x, y) = roof;
      }
    return RayCaster(std::make_shared<HeightField>(make_height_field({0, kCells * kCellM}, kCellM, height)),
                     SurfaceForm::bilinear);
  }();
  return caster;
}

// The heights as one Embree grid, in metres from the south-west corner.
class EmbreeTown {
 public:
  EmbreeTown() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    const HeightField& field = town().field();
    RTCGeometry grid = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(grid, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, field.height_m.size()));
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x) {
        const Vec3d p = field.map_from_cells({x + 0.5, y + 0.5, field.height_m(x, y)});
        *vertices++ = static_cast<float>(p.x), *vertices++ = static_cast<float>(p.y),
        *vertices++ = static_cast<float>(p.z);
      }
    auto* one = static_cast<RTCGrid*>(
        rtcSetNewGeometryBuffer(grid, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
    *one = {0, kCells, kCells, kCells};
    rtcCommitGeometry(grid);
    rtcAttachGeometry(scene_, grid);
    rtcReleaseGeometry(grid);
    rtcCommitScene(scene_);
  }
  ~EmbreeTown() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeTown(const EmbreeTown&) = delete;
  EmbreeTown& operator=(const EmbreeTown&) = delete;

  bool hits(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r{};
    r.ray.org_x = static_cast<float>(ray.origin.x), r.ray.org_y = static_cast<float>(ray.origin.y);
    r.ray.org_z = static_cast<float>(ray.origin.z);
    r.ray.dir_x = static_cast<float>(ray.direction.x), r.ray.dir_y = static_cast<float>(ray.direction.y);
    r.ray.dir_z = static_cast<float>(ray.direction.z);
    r.ray.tfar = std::numeric_limits<float>::infinity();
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &r);
    return r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

struct Seen {
  Vec3d eye, target;
  double fov_deg;
};
constexpr Seen kViews[] = {
    {{100, -900, 700}, {100, 100, 0}, 9}, {{60, 20, 40}, {100, 100, 5}, 30}, {{-20, 95, 12}, {200, 105, 8}, 30}};
constexpr const char* kViewNames[] = {"far", "near", "grazing"};

enum class Way { cells, hierarchy, detail_stop };

std::vector<Ray> rays_of(int seen) {
  const View view = perspective_view(look_at(kViews[seen].eye, kViews[seen].target), kViews[seen].fov_deg, {320, 180});
  std::vector<Ray> rays;
  for (int y = 0; y < view.size().height_px; ++y)
    for (int x = 0; x < view.size().width_px; ++x) rays.push_back(*view.ray({x + 0.5, y + 0.5}));
  return rays;
}

int hits_of(const std::vector<Ray>& rays) {
  int hits = 0;
  for (const Ray& ray : rays) hits += town().first_hit(ray).any();
  return hits;
}

void trace(benchmark::State& state, int seen, Way way) {
  const View view = perspective_view(look_at(kViews[seen].eye, kViews[seen].target), kViews[seen].fov_deg, {320, 180});
  const std::vector<Ray> rays = rays_of(seen);
  TraceOptions options;
  options.use_hierarchy = way != Way::cells;
  if (way == Way::detail_stop) options.pixel = view.pixel();
  std::int64_t steps = 0, rounds = 0;
  int hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Ray& ray : rays) hits += town().first_hit(ray, options, &steps).any();
    ++rounds;
  }
  const int expected = hits_of(rays);
  // The stop makes silhouettes up to a pixel wider.
  if (std::abs(hits - expected) > (way == Way::detail_stop ? static_cast<int>(rays.size()) / 100 : 0))
    state.SkipWithError("hits differ");
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays.size()) * static_cast<double>(rounds), benchmark::Counter::kIsRate);
  state.counters["steps/ray"] =
      static_cast<double>(steps) / static_cast<double>(rounds) / static_cast<double>(rays.size());
}

void embree(benchmark::State& state, int seen) {
  static const EmbreeTown oracle;
  const std::vector<Ray> rays = rays_of(seen);
  std::int64_t rounds = 0;
  int hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Ray& ray : rays) hits += oracle.hits(ray);
    ++rounds;
  }
  // Triangles for patches, floats for doubles: silhouettes differ.
  if (std::abs(hits - hits_of(rays)) > static_cast<int>(rays.size()) / 1000) state.SkipWithError("hits differ");
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays.size()) * static_cast<double>(rounds), benchmark::Counter::kIsRate);
}

void build_hierarchy(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(HeightHierarchy(town().field(), SurfaceForm::bilinear).levels());
}
BENCHMARK(build_hierarchy)->Unit(benchmark::kMillisecond);

void build_embree(benchmark::State& state) {
  town();
  for (auto _ : state) {
    const EmbreeTown built;
    benchmark::DoNotOptimize(&built);
  }
}
BENCHMARK(build_embree)->Unit(benchmark::kMillisecond);

int register_all() {
  for (int seen = 0; seen < 3; ++seen) {
    const auto add = [&](const std::string& name, auto run) {
      benchmark::RegisterBenchmark((kViewNames[seen] + ("/" + name)).c_str(), run)->Unit(benchmark::kMillisecond);
    };
    add("cells", [seen](benchmark::State& state) { trace(state, seen, Way::cells); });
    add("hierarchy", [seen](benchmark::State& state) { trace(state, seen, Way::hierarchy); });
    add("detail_stop", [seen](benchmark::State& state) { trace(state, seen, Way::detail_stop); });
    add("embree", [seen](benchmark::State& state) { embree(state, seen); });
  }
  return 0;
}

[[maybe_unused]] const int kRegistered = register_all();

}  // namespace

BENCHMARK_MAIN();
