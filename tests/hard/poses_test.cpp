// SPDX-License-Identifier: Apache-2.0
// Hard cases of poses and cameras as files give them: singular angles, rotations that are none, numbers that are none.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "camera/camera.h"
#include "core/random.h"
#include "formats/files.h"
#include "formats/pose_set.h"

namespace skysweep::hard {
namespace {

using formats::contains;

double largest_difference(const Mat3d& a, const Mat3d& b) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.m[i] - b.m[i]));
  return largest;
}

// Hard: looking straight down, yaw and roll turn about the same axis; a way through angles would lose one of them.
// Bound: the rotation is orthonormal and comes back from its quaternion to 1e-12, a nanodegree off the pole, too.
TEST(HardPoses, gimbal_lock) {
  for (const double pitch : {-90.0, 90.0, -90 + 1e-9, -90 - 1e-9, 90 - 1e-12}) {
    for (const double yaw : {0.0, 37.0, 90.0, 180.0, 359.999999}) {
      for (const double roll : {0.0, -53.0, 90.0, 180.0}) {
        const Mat3d r = camera::rotation_from_yaw_pitch_roll(yaw, pitch, roll);
        EXPECT_FALSE((camera::Pose{r, {}}.problem()));
        EXPECT_LT(largest_difference(r * transpose(r), Mat3d{}), 1e-15);
        const camera::Quaternion q = camera::quaternion_from_rotation(r);
        const auto back = camera::rotation_from_quaternion(q.w, q.x, q.y, q.z);
        ASSERT_TRUE(back);
        EXPECT_LT(largest_difference(*back, r), 1e-12) << yaw << " " << pitch << " " << roll;
      }
    }
  }
  for (const double phi : {90.0, -90.0}) {  // the pole of omega, phi, kappa
    const Mat3d a = camera::rotation_from_omega_phi_kappa(20, phi, 30);
    EXPECT_LT(largest_difference(a * transpose(a), Mat3d{}), 1e-15);
  }
}

// Hard: half turns have w = 0, where dividing by w would give infinity. Bound: as above, at and around every half turn.
TEST(HardPoses, quaternions_of_half_turns) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d axis = normalized({random.normal(), random.normal(), random.normal()});
    const double w = i % 2 == 0 ? 0 : 1e-9 * random.normal();
    const double s = std::sqrt(1 - w * w);
    const auto r = camera::rotation_from_quaternion(w, s * axis.x, s * axis.y, s * axis.z);
    ASSERT_TRUE(r);
    const camera::Quaternion q = camera::quaternion_from_rotation(*r);
    EXPECT_LT(largest_difference(*camera::rotation_from_quaternion(q.w, q.x, q.y, q.z), *r), 1e-12);
  }
}

// Hard: four decimals in a file make a quaternion of length 1.0003, whose matrix would scale the scene.
// Bound: normalised to a rotation that is orthonormal to 1e-15; what is no rotation at all is refused.
TEST(HardPoses, quaternions_not_quite_unit) {
  for (const double length : {0.91, 0.9997, 1.0003, 1.09}) {
    const auto r = camera::rotation_from_quaternion(0.5 * length, 0.5 * length, -0.5 * length, 0.5 * length);
    ASSERT_TRUE(r) << length;
    EXPECT_LT(largest_difference(*r * transpose(*r), Mat3d{}), 1e-15);
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kHuge = 1e200, kTiny = 5e-324;
  EXPECT_FALSE(camera::rotation_from_quaternion(0, 0, 0, 0));
  EXPECT_FALSE(camera::rotation_from_quaternion(kTiny, 0, 0, kTiny));
  EXPECT_FALSE(camera::rotation_from_quaternion(kHuge, kHuge, 0, 0));
  EXPECT_FALSE(camera::rotation_from_quaternion(kNaN, 0, 0, 1));
}

// Hard: a matrix that flattens space projects everything onto a line, and inverting it divides by zero.
// Bound: refused in words.
TEST(HardPoses, rank_deficient_and_nan_rotations) {
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Mat3d flat{{1, 0, 0, 0, 1, 0, 0, 0, 0}}, zero{{0, 0, 0, 0, 0, 0, 0, 0, 0}}, twice{{2, 0, 0, 0, 2, 0, 0, 0, 2}};
  for (const Mat3d& m : {flat, zero, twice})
    EXPECT_EQ(*(camera::Pose{m, {}}.problem()), "the rotation matrix is not orthonormal");
  EXPECT_EQ(*(camera::Pose{{{kNaN, 0, 0, 0, 1, 0, 0, 0, 1}}, {}}.problem()), "the rotation is not finite");
  EXPECT_EQ(*(camera::Pose{Mat3d{}, {0, kNaN, 0}}.problem()), "the position is not finite");
}

class HardPoseFiles : public formats::TestFolder {};

// Hard: one bad row must neither crash nor poison the others. Bound: refused with line and reason; the rest is read.
TEST_F(HardPoseFiles, poses_that_are_no_numbers_cost_themselves_only) {
  const std::string path = write("poses.csv",
                                 "image,x,y,z,qw,qx,qy,qz,width,height,fx,fy,cx,cy\n"
                                 "good.jpg,1,2,3,0,1,0,0,320,240,300,300,160,120\n"
                                 "nan.jpg,nan,2,3,0,1,0,0,320,240,300,300,160,120\n"
                                 "inf.jpg,1,inf,3,0,1,0,0,320,240,300,300,160,120\n"
                                 "far.jpg,1e300,2,3,0,1,0,0,320,240,300,300,160,120\n"
                                 "zero.jpg,1,2,3,0,0,0,0,320,240,300,300,160,120\n"
                                 "denormal_focal.jpg,1,2,3,0,1,0,0,320,240,5e-324,5e-324,160,120\n"
                                 "huge_focal.jpg,1,2,3,0,1,0,0,320,240,1e308,1e308,160,120\n"
                                 "far_axis.jpg,1,2,3,0,1,0,0,320,240,300,300,1e300,120\n"
                                 "denormal_place.jpg,5e-324,-5e-324,3,0,1,0,0,320,240,300,300,160,120\n");
  const formats::PoseSet poses = formats::read_poses(path);
  ASSERT_EQ(poses.images.size(), 2u);
  EXPECT_EQ(poses.images[0].name, "denormal_place.jpg");
  EXPECT_EQ(poses.images[0].pose.center.x, 0);
  EXPECT_EQ(poses.images[1].name, "good.jpg");
  ASSERT_EQ(poses.refused.size(), 7u);
  for (const formats::RefusedImage& image : poses.refused) {
    const std::string why = image.name.find("focal") != std::string::npos ? "focal length must lie between"
                            : image.name == "far_axis.jpg"                ? "principal point"
                            : image.name == "far.jpg"                     ? "10^9 m"
                            : image.name == "zero.jpg"                    ? "has not the length 1"
                                                                          : "is not a finite number";
    EXPECT_TRUE(contains(image.reason, why) && contains(image.reason, "poses.csv:")) << image.reason;
  }
}

// Hard: an angle-axis vector whose length overflows has neither sine nor cosine. Bound: refused in words, no abort.
TEST_F(HardPoseFiles, angle_axis_vectors_of_absurd_length) {
  const std::string path =
      write("reconstruction.json",
            R"([{"cameras": {"c": {"projection_type": "perspective", "width": 320, "height": 240, "focal": 0.9}},
     "shots": {"good.jpg": {"camera": "c", "rotation": [3.1, 0, 0], "translation": [0, 0, 5]},
               "long.jpg": {"camera": "c", "rotation": [1e200, 0, 0], "translation": [0, 0, 5]},
               "turns.jpg": {"camera": "c", "rotation": [1e6, 1e6, 0], "translation": [0, 0, 5]}}}])");
  const formats::PoseSet poses = formats::read_poses(path);
  EXPECT_EQ(poses.images.size(), 2u);
  ASSERT_EQ(poses.refused.size(), 1u);
  EXPECT_TRUE(contains(poses.refused[0].reason, "the rotation is no number of radians")) << poses.refused[0].reason;
}

// Hard: coefficients as large or as small as a double can hold. Bound: a pixel on the photograph or none, never NaN.
TEST(HardCameras, absurd_and_denormal_distortion_shows_finite_pixels_or_none) {
  constexpr double kTiny = 5e-324, kHuge = 1e300;
  for (const camera::Distortion& d : {camera::Distortion{.k1 = kTiny},
                                      {.k1 = kHuge},
                                      {.k1 = -kHuge},
                                      {.k1 = -1e8},
                                      {.k2 = kHuge, .k3 = -kHuge},
                                      {.p1 = kHuge},
                                      {.p1 = 0.7, .p2 = -0.7}}) {
    const camera::CameraModel model{320, 240, 300, 300, 160, 120, d};
    ASSERT_FALSE(model.problem());
    const camera::Camera camera(model, {camera::rotation_from_yaw_pitch_roll(0, -90, 0), {0, 0, 30}});
    for (int i = 0; i < 400; ++i) {
      const Vec3d point{-20.0 + 0.1 * i, 7.3 - 0.05 * i, 0};
      const auto pixel = camera.project(point);
      if (pixel && camera.shows(*pixel)) {
        EXPECT_TRUE(std::isfinite(pixel->x) && std::isfinite(pixel->y));
      }
      const auto ray = camera.ray({0.8 * i, 0.6 * i});
      if (ray) {
        EXPECT_NEAR(norm(*ray), 1, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace skysweep::hard
