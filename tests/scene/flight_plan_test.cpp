// SPDX-License-Identifier: Apache-2.0
#include "scene/flight_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "camera/camera.h"
#include "scene/world/ground.h"

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

TEST(FlightPlan, cross_strips_run_across_the_first_set) {
  Scene scene = plain_scene();
  const std::vector<camera::Pose> single = plan_flight(scene);
  scene.flight.cross_strips = true;
  const std::vector<camera::Pose> both = plan_flight(scene);
  ASSERT_GT(both.size(), single.size());
  for (std::size_t i = 0; i < single.size(); ++i) EXPECT_EQ(both[i], single[i]);
  // The second set flies eastwards first, with the top of the photographs to the east.
  const Vec3d flown = normalized(both[single.size() + 1].center - both[single.size()].center);
  EXPECT_NEAR(flown.x, 1, 1e-6);
  EXPECT_NEAR(both[single.size()].down().x, -1, 1e-12);
}

TEST(FlightPlan, four_looks_at_every_position_see_four_headings_at_the_angle_asked_for) {
  Scene scene = plain_scene();
  scene.flight.off_nadir_deg = 45;
  scene.flight.looks_deg = {0, 90, 180, 270};
  scene.flight.position_sigma_m = 1;
  const std::vector<camera::Pose> poses = plan_flight(scene);
  ASSERT_EQ(poses.size(), 4 * 48u);
  const Vec2d expected[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
  for (int look = 0; look < 4; ++look) {
    const camera::Pose& pose = poses[static_cast<std::size_t>(look)];
    EXPECT_EQ(pose.center, poses[0].center);  // one rig
    EXPECT_NEAR(camera::off_nadir_deg(pose), 45, 1e-9);
    EXPECT_NEAR(pose.view_direction().x, expected[look].x * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(pose.view_direction().y, expected[look].y * std::sqrt(0.5), 1e-12);
  }
  EXPECT_NE(poses[4].center, poses[0].center);
}

TEST(FlightPlan, a_flight_along_the_terrain_keeps_its_height_above_the_ground_below) {
  Scene scene = plain_scene();
  scene.terrain = {30, 60};
  scene.flight.terrain_following = true;
  const Ground ground(scene.terrain, scene.seed);
  double lowest = 1e9, highest = -1e9;
  for (const camera::Pose& pose : plan_flight(scene)) {
    EXPECT_NEAR(pose.center.z - ground.at({pose.center.x, pose.center.y}).z, 80, 1e-5);  // snapped
    lowest = std::min(lowest, pose.center.z);
    highest = std::max(highest, pose.center.z);
  }
  EXPECT_GT(highest - lowest, 10);
}

TEST(FlightPlan, every_altitude_is_flown_with_the_overlap_asked_for) {
  Scene scene = plain_scene();
  scene.flight.altitudes_m = {80, 160};
  const std::vector<camera::Pose> poses = plan_flight(scene);
  // At twice the height half as many: along 80 m at most 24 m apart, across 100 m at most 48 m.
  ASSERT_EQ(poses.size(), 48u + 5 * 4);
  EXPECT_EQ(poses[47].center.z, 80);
  EXPECT_EQ(poses[48].center.z, 160);
  EXPECT_DOUBLE_EQ(scene.gsd_m(), 0.1);  // of the lowest
}

TEST(FlightPlan, an_orbit_looks_at_its_target_from_all_sides) {
  Scene scene = plain_scene();
  scene.flight.pattern = FlightPattern::orbit;
  scene.flight.target = {40, 30, 5};
  scene.flight.radius_m = 60;
  scene.flight.altitudes_m = {45, 65};
  scene.flight.photographs = 12;
  const std::vector<camera::Pose> poses = plan_flight(scene);
  ASSERT_EQ(poses.size(), 24u);
  Vec2d sum;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const camera::Pose& pose = poses[i];
    EXPECT_NEAR(pose.center.z, i < 12 ? 45 : 65, 1e-9);
    EXPECT_NEAR(std::hypot(pose.center.x - 40, pose.center.y - 30), 60, 1e-5);
    const auto pixel = camera::Camera(scene.camera, pose).project(scene.flight.target);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, 400, 1e-3);
    EXPECT_NEAR(pixel->y, 300, 1e-3);
    EXPECT_NEAR(pose.right().z, 0, 1e-12);  // upright
    EXPECT_LT(pose.down().z, 0);
    sum = sum + Vec2d{pose.center.x, pose.center.y};
  }
  EXPECT_NEAR(sum.x / 24, 40, 1e-5);
  EXPECT_NEAR(scene.gsd_m(), std::hypot(60, 40) / 800, 1e-12);
}

TEST(FlightPlan, drift_is_slow_where_scatter_is_not) {
  Scene scene = plain_scene();
  scene.area_m = {2000, 400};
  scene.flight.along_overlap = 0.9;
  const auto plan = plan_flight(scene);
  const auto deviations = [&](Flight flight) {
    scene.flight = flight;
    std::vector<double> out;
    const auto flown = plan_flight(scene);
    for (std::size_t i = 0; i < flown.size(); ++i) out.push_back(flown[i].center.z - plan[i].center.z);
    return out;
  };
  const auto statistics = [](const std::vector<double>& v) {
    double squares = 0, products = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      squares += v[i] * v[i];
      if (i > 0) products += v[i] * v[i - 1];
    }
    return std::pair(std::sqrt(squares / static_cast<double>(v.size())), products / squares);
  };
  Flight drifting = scene.flight, scattered = scene.flight;
  drifting.drift_sigma_m = 2;
  drifting.drift_photographs = 10;
  scattered.position_sigma_m = 2;
  const auto [drift_sigma, drift_correlation] = statistics(deviations(drifting));
  const auto [scatter_sigma, scatter_correlation] = statistics(deviations(scattered));
  ASSERT_GT(plan.size(), 3000u);
  EXPECT_NEAR(drift_sigma, 2, 0.3);
  EXPECT_NEAR(drift_correlation, std::exp(-0.1), 0.03);
  EXPECT_NEAR(scatter_sigma, 2, 0.1);
  EXPECT_NEAR(scatter_correlation, 0, 0.05);
}

TEST(FlightPlan, drift_of_angles_turns_the_photographs_and_moves_none) {
  Scene scene = plain_scene();
  const auto plan = plan_flight(scene);
  scene.flight.tilt_drift_sigma_deg = 2;
  const auto flown = plan_flight(scene);
  double largest = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    EXPECT_EQ(flown[i].center, plan[i].center);
    largest = std::max(largest, camera::off_nadir_deg(flown[i]));
  }
  EXPECT_GT(largest, 1);
  EXPECT_LT(largest, 10);
}

TEST(FlightPlan, further_flights_follow_the_first_and_change_nothing_of_it) {
  Scene scene = plain_scene();
  scene.flight.position_sigma_m = 1;
  const auto first = plan_flight(scene);
  scene.further_flights = {scene.flight};
  const auto both = plan_flight(scene);
  ASSERT_EQ(both.size(), 2 * first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(both[i], first[i]);
    EXPECT_NE(both[first.size() + i].center, first[i].center);  // scatter of its own
  }
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
