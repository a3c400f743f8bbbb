// SPDX-License-Identifier: Apache-2.0
#include "sweep/shown_planes.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace skysweep::sweep {
namespace {

constexpr PlaneRange kPlanes{-40, 160};
constexpr double kStep = 0.25;  // planes from -10 to 40 m, some above the lowest cameras

// Cameras from 35 m up, some tilted far enough for their nadir to lie off the photograph.
SweepProblem problem_of(const camera::Distortion& distortion, double tilt_deg, Random& random) {
  static const ImagePyramid image(Array2d<Rgb8>(320, 240));
  SweepProblem problem;
  problem.dz_m = kStep;
  for (int i = 0; i < 8; ++i) {
    const camera::CameraModel model{320, 240, 300, 310, 150, 125, distortion};
    const Mat3d rotation = camera::rotation_from_yaw_pitch_roll(
        random.uniform(0, 360), -90 + random.uniform(-tilt_deg, tilt_deg), random.uniform(-tilt_deg, tilt_deg));
    const Vec3d center{random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), random.uniform(35.0, 70.0)};
    problem.views.push_back({&image, camera::Camera(model, {rotation, center}), 0});
  }
  return problem;
}

int asked_plane_by_plane(const SweepProblem& problem, Vec2d place, int k) {
  int n = 0;
  for (const View& view : problem.views) {
    const auto pixel = view.camera.project({place.x, place.y, k * problem.dz_m});
    n += pixel && view.camera.shows(*pixel);
  }
  return n;
}

// Places times planes at which the two ways disagree.
int disagreements(const camera::Distortion& distortion, double tilt_deg) {
  Random random(7);
  const SweepProblem problem = problem_of(distortion, tilt_deg, random);
  ShownPlanes shown(problem);
  int differing = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2d place{random.uniform(-45.0, 45.0), random.uniform(-45.0, 45.0)};
    shown.look_at(place, kPlanes);
    int expected_first = kPlanes.first;
    shown.for_each_run(kPlanes, [&](PlaneRange run, int n) {
      EXPECT_EQ(run.first, expected_first);
      expected_first = run.last + 1;
      for (int k = run.first; k <= run.last; ++k) {
        differing += n != asked_plane_by_plane(problem, place, k);
        EXPECT_EQ(n, shown.views_at(k));
      }
    });
    EXPECT_EQ(expected_first, kPlanes.last + 1);
  }
  return differing;
}

TEST(ShownPlanes, are_those_of_asking_every_view_at_every_plane) { EXPECT_EQ(disagreements({}, 5), 0); }

TEST(ShownPlanes, are_so_for_cameras_that_look_aside) { EXPECT_EQ(disagreements({}, 60), 0); }

TEST(ShownPlanes, miss_hardly_anything_that_lens_distortion_bends_over_the_border) {
  EXPECT_LE(disagreements({-0.1, 0.02, 1e-3, -5e-4, 0}, 5), 2000 * kPlanes.count() / 10000);
}

TEST(ShownPlanes, are_counted_within_the_planes_asked_for) {
  Random random(3);
  const SweepProblem problem = problem_of({}, 5, random);
  ShownPlanes shown(problem);
  shown.look_at({0, 0}, kPlanes);
  int planes = 0;
  shown.for_each_run({10, 19}, [&](PlaneRange run, int) { planes += run.count(); });
  EXPECT_EQ(planes, 10);
}

}  // namespace
}  // namespace skysweep::sweep
