// SPDX-License-Identifier: Apache-2.0
#include "scene/world/idle_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace skysweep::scene {
namespace {

// Embree without AVX-512 tells idle lanes by this alone, whatever the mask says; on this machine it may look elsewhere.
TEST(IdleRays, end_before_they_begin_whatever_the_stack_held) {
  RTCRay16 rays;
  std::memset(&rays, 0xff, sizeof rays);
  make_idle(rays);
  for (int i = 0; i < 16; ++i) {
    EXPECT_GT(rays.tnear[i], rays.tfar[i]);
    for (const float v : {rays.org_x[i], rays.org_y[i], rays.org_z[i], rays.dir_x[i], rays.dir_y[i], rays.time[i]})
      EXPECT_EQ(v, 0);
    EXPECT_EQ(rays.dir_z[i], 1);
    EXPECT_EQ(rays.flags[i], 0u);
  }
}

}  // namespace
}  // namespace skysweep::scene
