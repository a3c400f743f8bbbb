// SPDX-License-Identifier: Apache-2.0
// Our camera against OpenCV's, an independent implementation of the same lens model. OpenCV counts pixels from the
// centre of the top-left one: its coordinates are ours less half a pixel.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <vector>

#include "camera/camera.h"
#include "core/random.h"

namespace skysweep::camera {
namespace {

struct OpenCvCamera {
  cv::Matx33d intrinsics;
  std::vector<double> distortion;
  cv::Vec3d rotation_vector, translation;
};

OpenCvCamera to_opencv(const Camera& camera) {
  const CameraModel& m = camera.model();
  const Distortion& d = m.distortion;
  const Mat3d& r = camera.pose().cam_from_world;
  const Vec3d t = -(r * camera.pose().center);
  OpenCvCamera out;
  out.intrinsics = {m.fx_px, 0, m.cx_px - 0.5, 0, m.fy_px, m.cy_px - 0.5, 0, 0, 1};
  out.distortion = {d.k1, d.k2, d.p1, d.p2, d.k3};
  cv::Rodrigues(cv::Matx33d(r.m.data()), out.rotation_vector);
  out.translation = {t.x, t.y, t.z};
  return out;
}

cv::Point2d project_with_opencv(const OpenCvCamera& camera, Vec3d p) {
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{p.x, p.y, p.z}}, camera.rotation_vector, camera.translation,
                    camera.intrinsics, camera.distortion, pixels);
  return pixels.front();
}

const std::vector<Distortion> kLenses = {
    {},                                      // none
    {-0.40, 0.20, 0, 0, 0},                  // strong barrel
    {0.15, -0.05, 0, 0, 0.01},               // pincushion
    {0, 0, 0.01, -0.02, 0},                  // decentred only
    {-0.11, 0.02, 0.001, -0.0005, -0.0003},  // a drone's
};

Pose random_pose(Random& random) {
  return {rotation_from_yaw_pitch_roll(random.uniform(-180, 180), random.uniform(-90, 20), random.uniform(-30, 30)),
          snap_position({random.uniform(-300, 300), random.uniform(-300, 300), random.uniform(50, 200)})};
}

TEST(OpenCvConvention, projection_differs_by_exactly_half_a_pixel) {
  Random random(11);
  for (const Distortion& lens : kLenses) {
    const CameraModel model{4000, 3000, 2950, 3010, 2017.3, 1466.8, lens};
    for (int trial = 0; trial < 100; ++trial) {
      const Camera camera(model, random_pose(random));
      // A point somewhere in the field of view.
      const double depth = random.uniform(20, 500);
      const Vec3d in_camera{depth * random.uniform(-0.65, 0.65), depth * random.uniform(-0.5, 0.5), depth};
      const Vec3d world = camera.pose().center + transpose(camera.pose().cam_from_world) * in_camera;
      const auto ours = camera.project(world);
      ASSERT_TRUE(ours);
      const cv::Point2d theirs = project_with_opencv(to_opencv(camera), world);
      EXPECT_NEAR(ours->x, theirs.x + 0.5, 1e-7);
      EXPECT_NEAR(ours->y, theirs.y + 0.5, 1e-7);
    }
  }
}

TEST(OpenCvConvention, undistortion_agrees) {
  const cv::TermCriteria until_exact(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 500, 1e-14);
  for (const Distortion& lens : kLenses) {
    const std::vector<double> coefficients = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
    for (double y = -0.4; y <= 0.4; y += 0.1)
      for (double x = -0.4; x <= 0.4; x += 0.1) {
        std::vector<cv::Point2d> theirs;
        cv::undistortPoints(std::vector<cv::Point2d>{{x, y}}, theirs, cv::Matx33d::eye(), coefficients, cv::noArray(),
                            cv::noArray(), until_exact);
        const auto ours = undistort(lens, {x, y});
        ASSERT_TRUE(ours);
        EXPECT_NEAR(ours->x, theirs.front().x, 1e-9);
        EXPECT_NEAR(ours->y, theirs.front().y, 1e-9);
      }
  }
}

}  // namespace
}  // namespace skysweep::camera
