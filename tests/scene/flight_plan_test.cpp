// SPDX-License-Identifier: Apache-2.0
#include "scene/flight_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "camera/camera.h"

namespace skysweep::scene {
namespace {

Scene plain_scene() {
  Scene scene;
  scene.area_m = {100, 80};
  scene.camera = camera::camera_from_sensor(10, 10, 800, 600);  // f = 800 px: altitude 80 m, footprint 80 m x 60 m
  scene.flight.gsd_m = 0.1;
  return scene;
}

TEST(FlightPlan, strips_run_to_and_fro_with_at_least_the_overlap_asked_for) {
  const Scene scene = plain_scene();
  const std::vector<camera::Pose> poses = plan_flight(scene);
  // Along: 80 m at most 12 m apart are 8 positions; across: 100 m at most 24 m apart are 6 strips.
  ASSERT_EQ(poses.size(), 48u);
  EXPECT_EQ(poses[0].center, (Vec3d{0, 0, 80}));
  EXPECT_EQ(poses[7].center, (Vec3d{0, 80, 80}));
  EXPECT_EQ(poses[8].center, (Vec3d{20, 80, 80}));
  EXPECT_LE(poses[1].center.y - poses[0].center.y, 12);
}

TEST(FlightPlan, the_top_of_the_photograph_points_in_the_direction_of_flight) {
  Scene scene = plain_scene();
  scene.flight.heading_deg = 90;
  const std::vector<camera::Pose> poses = plan_flight(scene);
  const Vec3d flown = normalized(poses[1].center - poses[0].center);
  EXPECT_NEAR(flown.x, 1, 1e-6);
  EXPECT_NEAR(dot(poses[0].down(), flown), -1, 1e-6);
  const Vec3d flown_last = normalized(poses.back().center - poses[poses.size() - 2].center);
  EXPECT_NEAR(dot(poses.back().down(), flown_last), -1, 1e-6);
}

TEST(FlightPlan, scatter_of_position_does_not_change_the_turns) {
  Scene scene = plain_scene();
  scene.flight.tilt_sigma_deg = 2;
  const auto tilted = plan_flight(scene);
  scene.flight.position_sigma_m = 1;
  const auto both = plan_flight(scene);
  for (std::size_t i = 0; i < tilted.size(); ++i) {
    EXPECT_EQ(tilted[i].cam_from_world, both[i].cam_from_world);
    EXPECT_NE(tilted[i].center, both[i].center);
  }
}

TEST(FlightPlan, off_nadir_photographs_look_forward) {
  Scene scene = plain_scene();
  scene.flight.off_nadir_deg = 40;
  const camera::Pose pose = plan_flight(scene).front();
  EXPECT_NEAR(camera::off_nadir_deg(pose), 40, 1e-9);
  EXPECT_GT(pose.view_direction().y, 0.5);
}

TEST(FlightPlan, the_visible_ground_holds_all_footprints_and_the_mapped_area) {
  const Scene scene = plain_scene();
  const Box2d box = visible_ground(scene, plan_flight(scene));
  EXPECT_LT(box.min.x, -40);
  EXPECT_GT(box.max.y, 80 + 30);
  EXPECT_LT(box.width(), 200);
}

}  // namespace
}  // namespace skysweep::scene
