// SPDX-License-Identifier: Apache-2.0
// The ray caster on the device must find what the scalar reference finds: the same hits, faces, sides and levels on
// 99.99 % of the rays, distances within a thousandth of a cell. (Both are in double; a device may round a division by
// one unit otherwise, which moves a ray that grazes a corner to the other side of it.)
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "gpu/gpu_device.h"
#include "render/landscapes.h"
#include "render/tracer.h"

namespace skysweep::render {
namespace {

std::vector<Ray> rays_around(const HeightField& field, int count) {
  Random random(23);
  std::vector<Ray> rays;
  const auto towards = [&](Vec3d from, Vec3d to) {
    const Vec3d a = field.map_from_cells(from), b = field.map_from_cells(to);
    rays.push_back({a, normalized(b - a)});
  };
  for (int i = 0; i < count; ++i) {
    const Vec3d target{random.uniform(0, 39), random.uniform(0, 34), random.uniform(-3, 6)};
    const double z = random.uniform(-6, 14);
    switch (i % 4) {
      case 0: towards({random.uniform(-60, 100), random.uniform(-60, 100), z}, target); break;
      case 1: towards({random.uniform(0, 39), random.uniform(0, 34), z}, target); break;  // from inside, or below
      case 2: towards({target.x, target.y, 30}, target); break;                           // plumb
      default: towards({-20, std::floor(target.y), 4}, {40, std::floor(target.y), 0});    // along borders
    }
  }
  return rays;
}

class RenderContract : public testing::TestWithParam<SurfaceForm> {};

TEST_P(RenderContract, the_device_finds_what_the_reference_finds) {
  SKY_OPEN_GPU_OR_SKIP(device);
  const auto field = hard_landscape({1e7, -2e6});
  const RayCaster caster(field, GetParam());
  SerialExecutor serial;
  const auto reference = make_cpu_tracer(caster, serial), on_device = make_gpu_tracer(caster, *device);
  const std::vector<Ray> rays = rays_around(*field, 20000);
  TraceOptions coarse, cells;
  coarse.pixel = {0.2, 0.02};
  cells.use_hierarchy = false;
  for (const TraceOptions& options : {TraceOptions{}, coarse, cells}) {
    const std::vector<Hit> expected = reference->first_hits(rays, options),
                           found = on_device->first_hits(rays, options);
    int differ = 0, hits = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit &a = expected[i], &b = found[i];
      hits += a.any();
      if (a.any() != b.any() || a.face != b.face || a.level != b.level || a.from_below != b.from_below)
        ++differ;
      else if (a.any())
        farthest = std::max(farthest, std::abs(a.distance_m - b.distance_m));
    }
    EXPECT_GT(hits, static_cast<int>(rays.size()) / 3);
    EXPECT_LE(differ, static_cast<int>(rays.size()) / 10000);
    EXPECT_LT(farthest, 1e-3 * field->cell_m);
    RecordProperty("differ", differ);
    RecordProperty("farthest_m", std::to_string(farthest));
  }
  EXPECT_NEAR(static_cast<double>(on_device->steps()), static_cast<double>(reference->steps()),
              1e-3 * static_cast<double>(reference->steps()));
}

INSTANTIATE_TEST_SUITE_P(Forms, RenderContract, testing::Values(SurfaceForm::boxes, SurfaceForm::bilinear),
                         [](const auto& tested) { return tested.param == SurfaceForm::boxes ? "boxes" : "bilinear"; });

TEST(RenderFallback, a_lost_device_is_told_of_once_and_the_reference_goes_on) {
  SKY_OPEN_GPU_OR_SKIP(device);
  const auto field = hard_landscape({0, 0});
  const RayCaster caster(field, SurfaceForm::boxes);
  SerialExecutor serial;
  std::vector<std::string> told;
  const auto tracer = with_fallback(make_gpu_tracer(caster, *device), make_cpu_tracer(caster, serial),
                                    [&](const std::string& sentence) { told.push_back(sentence); });
  const std::vector<Ray> rays = rays_around(*field, 100);
  tracer->first_hits(rays, {});
  EXPECT_TRUE(told.empty());
  device->give_up();
  const std::vector<Hit> hits = tracer->first_hits(rays, {});
  tracer->first_hits(rays, {});
  EXPECT_EQ(told.size(), 1u);
  EXPECT_EQ(hits.front().distance_m, caster.first_hit(rays.front()).distance_m);
}

}  // namespace
}  // namespace skysweep::render
