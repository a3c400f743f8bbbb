// SPDX-License-Identifier: Apache-2.0
#include "render/view_counts.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "render/view.h"

namespace skysweep::render {
namespace {

TEST(ViewCounts, are_those_of_asking_every_camera) {
  const Box3d bounds{{1000, 2000, 10}, {1100, 2080, 25}};
  Random random(9);
  std::vector<camera::Camera> cameras;
  for (int i = 0; i < 20; ++i) {
    const Vec3d eye{random.uniform(980, 1120), random.uniform(1980, 2100), random.uniform(50, 90)};
    cameras.emplace_back(camera::camera_from_sensor(20, 12, 300, 200),
                         look_at(eye, {eye.x + random.uniform(-20, 20), eye.y + random.uniform(-20, 20), 10}));
  }
  const ViewCounts counts(cameras, bounds);
  int largest = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3d place{random.uniform(1000, 1100), random.uniform(2000, 2080), random.uniform(10, 25)};
    int expected = 0;
    for (const camera::Camera& camera : cameras) {
      const std::optional<Vec2d> pixel = camera.project(place);
      expected += pixel && camera.shows(*pixel);
    }
    ASSERT_EQ(counts.at(place), expected);
    largest = std::max(largest, expected);
  }
  EXPECT_GT(counts.most(), 0);
  EXPECT_LE(counts.most(), largest + 2);
}

}  // namespace
}  // namespace skysweep::render
