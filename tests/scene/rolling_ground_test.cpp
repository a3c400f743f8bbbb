// SPDX-License-Identifier: Apache-2.0
#include "scene/world/rolling_ground.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "scene/world/ground.h"

namespace skysweep::scene {
namespace {

struct Batch {
  std::vector<Ray> rays;
  std::array<float, kRayBatch> t;
};

// Rays from a few hundred metres that a mesh has met millimetres from the ground.
Batch rays_near(const Ground& ground, Random& random) {
  Batch out;
  for (float& t : out.t) {
    const Vec2d p{random.uniform(-3000, 3000), random.uniform(-3000, 3000)};
    const Vec3d hit{p.x, p.y, ground.at(p).z};
    const Vec3d direction{random.uniform(-1, 1), random.uniform(-1, 1), -1};
    const double distance = random.uniform(50, 400);
    out.rays.push_back({hit - distance * direction, direction});
    t = static_cast<float>(distance + random.uniform(-0.005, 0.005));
  }
  return out;
}

// The same, ray by ray with the ground's own height and slope.
Vec3d newton_step(const Ground& ground, const Ray& ray, double t, Vec3d& normal) {
  const Vec3d near = ray.origin + t * ray.direction;
  const Ground::Sample here = ground.at({near.x, near.y});
  const Vec3d up{-here.slope.x, -here.slope.y, 1};
  normal = normalized(up);
  return near + (dot(up, Vec3d{near.x, near.y, here.z} - near) / dot(up, ray.direction)) * ray.direction;
}

TEST(RollingGround, is_met_by_a_batch_where_each_ray_meets_it) {
  const Ground ground(Terrain{.relief_m = 8, .wavelength_m = 70}, 5);
  ASSERT_NE(ground.rolling(), nullptr);
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const Batch batch = rays_near(ground, random);
    GroundHits hits;
    meet_rolling_ground(ground.rolling(), RayLanes(batch.rays.data(), kRayBatch), batch.t.data(), hits);
    for (std::size_t i = 0; i < kRayBatch; ++i) {
      Vec3d normal;
      const Vec3d expected = newton_step(ground, batch.rays[i], static_cast<double>(batch.t[i]), normal);
      EXPECT_LT(norm(Vec3d{hits.x[i], hits.y[i], hits.z[i]} - expected), 1e-10);
      EXPECT_LT(norm(Vec3d{hits.nx[i], hits.ny[i], hits.nz[i]} - normal), 1e-12);
      EXPECT_NEAR(hits.z[i], ground.at({hits.x[i], hits.y[i]}).z, 5e-6);  // what a second step would still move it by
    }
  }
}

TEST(RollingGround, without_relief_is_the_plane_at_zero) {
  const Ground level(Terrain{}, 5);
  EXPECT_EQ(level.rolling(), nullptr);
  const Ray down{{3, 4, 100}, {0.5, 0, -1}};
  const float t[kRayBatch] = {99.999f};
  GroundHits hits;
  meet_rolling_ground(level.rolling(), RayLanes(&down, 1), t, hits);
  EXPECT_EQ((Vec3d{hits.x[0], hits.y[0], hits.z[0]}), (Vec3d{53, 4, 0}));
  EXPECT_EQ((Vec3d{hits.nx[0], hits.ny[0], hits.nz[0]}), (Vec3d{0, 0, 1}));
}

}  // namespace
}  // namespace skysweep::scene
