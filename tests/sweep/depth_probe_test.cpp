// SPDX-License-Identifier: Apache-2.0
#include "sweep/depth_probe.h"

#include <gtest/gtest.h>

#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

std::optional<DepthProbe> probe_of(const test::SyntheticProblem& p) {
  return probe_depth(p.problem.views[0], {p.problem.views.begin() + 1, p.problem.views.end()});
}

TEST(DepthProbe, finds_the_distance_to_the_ground_without_being_told_anything) {
  const test::SyntheticProblem p = test::ring_of_views(5, test::small_camera(), [](double, double) { return 0.0; });
  const std::optional<DepthProbe> probe = probe_of(p);
  ASSERT_TRUE(probe);
  const double truth = p.problem.views[0].camera.pose().center.z;
  EXPECT_NEAR(probe->median_m, truth, 0.05 * truth);
  EXPECT_NEAR(probe->nearest_m, truth, 0.15 * truth);
  EXPECT_NEAR(probe->farthest_m, truth, 0.15 * truth);
}

TEST(DepthProbe, does_not_mind_exposure) {
  test::SyntheticProblem p = test::ring_of_views(3, test::small_camera(), [](double, double) { return 0.0; });
  Array2d<Rgb8> dark = test::photograph_of(p.problem.views[0].camera, [](double, double) { return 0.0; });
  for (Rgb8& c : dark) c.r = c.g = c.b = static_cast<std::uint8_t>(c.r * 0.7 + 20);
  const ImagePyramid image(dark);
  p.problem.views[0].image = &image;
  const std::optional<DepthProbe> probe = probe_of(p);
  ASSERT_TRUE(probe);
  EXPECT_NEAR(probe->median_m, 30, 2.5);
}

TEST(DepthProbe, knows_nothing_about_photographs_of_different_places) {
  test::SyntheticProblem p = test::ring_of_views(2, test::small_camera(), [](double, double) { return 0.0; });
  const camera::Pose elsewhere{camera::rotation_from_yaw_pitch_roll(0, -90, 0), {500, 300, 30}};
  const ImagePyramid other(
      test::photograph_of(camera::Camera(test::small_camera(), elsewhere), [](double, double) { return 0.0; }));
  p.problem.views[1].image = &other;
  EXPECT_FALSE(probe_of(p));
}

TEST(DepthProbe, knows_nothing_without_a_baseline) {
  const test::SyntheticProblem p = test::ring_of_views(1, test::small_camera(), [](double, double) { return 0.0; });
  EXPECT_FALSE(probe_depth(p.problem.views[0], {p.problem.views[0]}));
}

}  // namespace
}  // namespace skysweep::sweep
